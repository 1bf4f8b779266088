#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// A vector of the model as three components, the third 0 in the plane.
template <int D>
Eigen::Vector3d widened(const Eigen::Matrix<double, D, 1>& x) {
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  y.head<D>() = x;
  return y;
}

}  // namespace nurbeam
