#pragma once
#include <Eigen/Core>

#include "fem/time_table.h"

namespace nurbeam {

/// A vector at one place of a beam, which may move along it: what a force and a moment have in common.
struct LoadAtPlace {
  int beam = 0;
  double s = 0;                                     ///< place at t = 0 [m]
  double speed = 0;                                 ///< ds/dt of the place [m/s]
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< [N] or [N m]
  bool follower = false;  ///< turns with the tangent, of a beam with torsion with the section
  TimeTable time = {};    ///< factor
  /// Of a force on a beam with torsion: of where it acts from the axis, along d1 and d2 [m].
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  bool permanent = false;  ///< part of the state that buckling is about, not of the loads that it multiplies
};

}  // namespace nurbeam
