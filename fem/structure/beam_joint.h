#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

namespace nurbeam {

/// Joins two beams at a place of each, which no body slides over: their material points there stay together
/// (at the distance they have in the drawing).
struct BeamJoint {
  int beam_a;
  double s_a;  ///< [m]
  int beam_b;
  double s_b;          ///< [m]
  bool rigid = false;  ///< the angle between the slopes stays too (HeldAngle), or where both beams have
                       ///< torsion the orientation of their sections (JoinedSections); else a hinge
  std::string name = {};
  /// Of a hinge of two beams with torsion: their sections turn against each other about this axis alone,
  /// which is given as drawn.
  std::optional<Eigen::Vector3d> axis = {};
};

}  // namespace nurbeam
