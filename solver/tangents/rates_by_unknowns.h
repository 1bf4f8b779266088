#pragma once
#include <Eigen/Core>
#include <functional>

namespace nurbeam {

/// (unknowns x quantities) derivatives of quantities by each of the unknowns x, of which `steps` has how far
/// to go for them at most: by differences with an error of the fourth order, less far where a quantity
/// changes by more than a thousandth of itself, down to a thousandth of the step. Quantities that depend on
/// few unknowns take few evaluations: halves of them that change nothing are left out whole.
Eigen::MatrixXd rates_by_unknowns(const std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>& quantities,
                                  const Eigen::VectorXd& x, const Eigen::VectorXd& steps);

}  // namespace nurbeam
