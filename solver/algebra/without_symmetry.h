#pragma once
#include <Eigen/Core>
#include <cmath>

namespace nurbeam {

/// (n) A vector to start iterations with, which no symmetry makes orthogonal to the solution.
inline Eigen::VectorXd without_symmetry(int n) {
  return Eigen::VectorXd::NullaryExpr(
      n, [](Eigen::Index i) { return 1 + 0.5 * std::sin(12.9898 * static_cast<double>(i + 1)); });
}

}  // namespace nurbeam
