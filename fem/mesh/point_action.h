#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// A force and a couple on a material point of an element.
struct PointAction {
  int element;
  double s;                                          ///< as the element counts it [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d couple = Eigen::Vector3d::Zero();  ///< [N m]
};

}  // namespace nurbeam
