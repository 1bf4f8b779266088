#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fem/structure/beam.h"
#include "fem/time_table.h"

namespace nurbeam {

/// A point mass with coordinates of its own: on no beam, on one, or where two cross.
struct Body {
  std::string name;
  double mass;  ///< [kg]
  /// Where it starts and how fast, when no sliding joint says so [m], [m/s].
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();
  double roll_inertia = 0;  ///< about the tangent of a section that it follows [kg m^2]
};

/// Ties a body to a moving place on a beam.
struct SlidingJoint {
  int body;
  int beam;
  double s;                            ///< at t = 0 [m]
  double speed = 0;                    ///< at t = 0 [m/s]
  std::optional<TimeTable> motion;     ///< prescribed s(t) [m]
  std::optional<double> release = {};  ///< held at s until then [s]
  bool continuous_slope = true;
  bool leave_at_end = true;  ///< else it stops there
  /// Of a beam with torsion: the body rolls with the section where it is, at the offset (along d1 and d2)
  /// from the axis [m].
  bool follows_section = false;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();

  bool is_offset() const { return follows_section && offset != Eigen::Vector2d::Zero(); }
};

/// All that has coordinates: beams, bodies, and the joints that make nodes of the beams move.
///
/// Coordinates are the model's own frame: for dimension 2 the plane of the model (third components zero).
struct Structure {
  int dimension = 3;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s^2]
  std::vector<Beam> beams;
  std::vector<Body> bodies;
  std::vector<SlidingJoint> joints;

  const Beam& beam_of(const SlidingJoint& joint) const { return beams[joint.beam]; }
  const Body& body_of(const SlidingJoint& joint) const { return bodies[joint.body]; }
};

}  // namespace nurbeam
