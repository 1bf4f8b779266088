#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

namespace nurbeam {

enum class EventKind {
  split,           ///< nodes were inserted
  merge,           ///< a node was removed
  becomes_point,   ///< a body is carried as a point of the mesh
  becomes_node,    ///< a body is carried as a node
  left_beam,       ///< a body has left the beam
  stopped_at_end,  ///< a body has stopped at the end
  released,        ///< a body that was held is free to slide
  sticks,          ///< a body with friction comes to rest on its beam
  slides,          ///< a body breaks loose, or has turned round
  hits_stop,       ///< a body comes to a stop, hard or with a buffer, and is thrown back or pressed in
  rests_at_stop,   ///< a body comes to rest against a hard stop
  leaves_stop      ///< a body is no longer pressed to its stop
};
/// Whether the energy account includes what an event takes or gives.
inline bool is_booked(EventKind kind) { return kind >= EventKind::left_beam; }

/// An event at one moment of a run: a change of the mesh, a body at a beam's end, ...
struct RunEvent {
  double time = 0;  ///< [s]
  EventKind kind = EventKind::split;
  int beam = -1, body = -1;                    ///< indices in the model
  std::optional<double> s;                     ///< reference arc length of the body [m]
  double energy_before = 0, energy_after = 0;  ///< [J]
  Eigen::Vector3d momentum_before = Eigen::Vector3d::Zero(),
                  momentum_after = Eigen::Vector3d::Zero();  ///< [kg m/s]
  /// Momentum from the supports when velocities were projected [kg m/s].
  Eigen::Vector3d support_impulse = Eigen::Vector3d::Zero();
  double length_before = 0, length_after = 0;  ///< deformed length of the beam [m]
};

}  // namespace nurbeam
