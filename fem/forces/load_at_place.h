#pragma once
#include <Eigen/Core>

#include "fem/time_table.h"

namespace nurbeam {

/// A vector at one place of a beam, which may move along the beam: the common data of a force and a moment.
struct LoadAtPlace {
  int beam = 0;
  double s = 0;                                     ///< place at t = 0 [m]
  double speed = 0;                                 ///< ds/dt of the place [m/s]
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< [N] or [N m]
  bool follower = false;  ///< the vector turns with the tangent; on a beam with torsion, with the section
  TimeTable time = {};    ///< factor
  /// Offset of a force from the axis of a beam with torsion, along d1 and d2 [m].
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  /// Part of the state that buckling is about, not of the loads that buckling multiplies.
  bool permanent = false;
};

}  // namespace nurbeam
