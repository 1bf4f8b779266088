#pragma once
#include <Eigen/Core>
#include <functional>

namespace nurbeam {

/// (unknowns x quantities) Derivatives of quantities by the unknowns x, by differences with an error of
/// fourth order. `steps`: the largest difference for each unknown. A difference is reduced, down to a
/// thousandth of its step, if a quantity changes by more than a thousandth of itself. Quantities that depend
/// on few unknowns take few evaluations: halves of the unknowns that change nothing are skipped.
Eigen::MatrixXd rates_by_unknowns(const std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>& quantities,
                                  const Eigen::VectorXd& x, const Eigen::VectorXd& steps);

}  // namespace nurbeam
