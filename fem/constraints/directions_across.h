#pragma once
#include <Eigen/Geometry>

namespace nurbeam {

/// D - 1 directions across t. In the plane the direction is as long as t. In space the two are at right
/// angles to each other; the first has unit length, the second is as long as t.
template <int D>
Eigen::Matrix<double, D - 1, D> directions_across(const Eigen::Vector3d& t) {
  Eigen::Matrix<double, D - 1, D> n;
  if constexpr (D == 2) {
    n << -t.y(), t.x();
  } else {
    // The first axis that is about as far from t as any. In drawings two axes are often equally far;
    // directions close to t then take the same one.
    constexpr double about = 0.1234;
    const Eigen::Vector3d along = t.cwiseAbs();
    int axis = 0;
    while (along[axis] > along.minCoeff() + about * t.norm()) ++axis;
    const Eigen::Vector3d first = t.cross(Eigen::Vector3d::Unit(axis)).normalized();
    n.row(0) = first;
    n.row(1) = t.cross(first);
  }
  return n;
}

}  // namespace nurbeam
