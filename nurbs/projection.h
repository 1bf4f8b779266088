#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// Derivatives 0..n of r = A / W from those of the homogeneous (A, W): column k is d^k r, 3 x (n+1).
///
/// r^(k) = (A^(k) - sum_{j=1..k} C(k,j) W^(j) r^(k-j)) / W (The NURBS Book, Eq. 4.8). homogeneous: 4 x (n+1),
/// column k = (A^(k), W^(k)), W != 0.
template <int Columns>
Eigen::Matrix<double, 3, Columns> projected_derivatives(
    const Eigen::Matrix<double, 4, Columns>& homogeneous) {
  Eigen::Matrix<double, 3, Columns> derivatives(3, homogeneous.cols());
  for (int k = 0; k < homogeneous.cols(); ++k) {
    Eigen::Vector3d sum = homogeneous.col(k).template head<3>();
    double binomial = 1;
    for (int j = 1; j <= k; ++j) {
      binomial *= double(k - j + 1) / j;
      sum -= binomial * homogeneous(3, j) * derivatives.col(k - j);
    }
    derivatives.col(k) = sum / homogeneous(3, 0);
  }
  return derivatives;
}

}  // namespace nurbeam
