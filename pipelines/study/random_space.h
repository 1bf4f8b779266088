#pragma once
#include <Eigen/Core>
#include <vector>

#include "pipelines/study/openturns_study.h"

namespace nurbeam {

/// The indices of the variables of a design, and of those that are random in it.
std::vector<std::size_t> design_variables(const StudyFile& study);
std::vector<std::size_t> random_variables(const StudyFile& study);

/// The values of design variables by their names.
ExpressionScope scope_of_design(const StudyFile& study, const std::vector<double>& design);

/// The random variables of a study at one design, in standard normal space: x_i = F_i^-1(Phi(u_i)), each
/// independent of the others. Throws std::runtime_error where a distribution is none there.
class RandomSpace {
 public:
  /// `design`: values of the design variables.
  RandomSpace(const StudyFile& study, const std::vector<double>& design);

  std::size_t size() const { return laws_.size(); }
  std::vector<double> values(const Eigen::VectorXd& u) const;
  /// dx_i/du_i = phi(u_i) / f_i(x_i).
  std::vector<double> slopes(const Eigen::VectorXd& u) const;
  /// The inverse of `values`.
  Eigen::VectorXd standard(const std::vector<double>& values) const;
  std::vector<double> deviations() const;  ///< standard ones

 private:
  std::vector<OT::Distribution> laws_;
};

/// The values of the free variables, of a design and of the random variables.
std::vector<double> joined(const StudyFile& study, const std::vector<double>& design,
                           const std::vector<double>& random);

}  // namespace nurbeam
