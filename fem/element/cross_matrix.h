#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// The matrix A with A b = a x b.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  A(2, 1) = a.x();
  A(1, 2) = -a.x();
  A(0, 2) = a.y();
  A(2, 0) = -a.y();
  A(1, 0) = a.z();
  A(0, 1) = -a.z();
  return A;
}

}  // namespace nurbeam
