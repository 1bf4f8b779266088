#pragma once
#include <optional>
#include <stdexcept>
#include <vector>

#include "fem/model/build.h"
#include "fem/system/beam_system.h"

/// What slides on what and what is fastened to what: the one place where the tests of constraints and forces
/// know how a model says so.
namespace nurbeam::testing {

/// How a body slides along a beam.
struct Sliding {
  double mass = 0.8;
  bool kinked = false;                         ///< the slope of the beam is discontinuous at it
  bool as_point = false;                       ///< it stays a point of the mesh
  std::optional<Eigen::Vector2d> offset = {};  ///< it follows the section, there
  std::optional<Friction> friction = {};
  std::optional<PlaceMotion> motion = {};
};

/// A body that slides; returns its number.
inline int add_sliding(ModelBuilder& builder, int beam, double s, const Sliding& how = {}) {
  const int body = builder.add_body("sliding body", how.mass);
  Rider& rider = builder.slide(body, beam, s);
  rider.continuous_slope = !how.kinked;
  rider.as_point = how.as_point;
  rider.follows_section = how.offset.has_value();
  rider.offset = how.offset.value_or(Eigen::Vector2d::Zero());
  rider.friction = how.friction;
  rider.motion = how.motion;
  return body;
}

/// What ties a body to its beam, by its number among those of the model.
inline int tie_of(const Structure& structure, int body) {
  for (int j = 0; j < static_cast<int>(structure.riders.size()); ++j)
    if (structure.riders[j].body == body) return j;
  throw std::invalid_argument("the body is on no beam");
}

/// First of the coordinates of a body, and that of its place on the beam.
inline int position_of(const BeamSystem& system, int body) { return system.mesh().bodies[body]; }
inline int place_of(const BeamSystem& system, int body) {
  return system.mesh().riders[tie_of(system.model(), body)].place;
}
/// The coordinates of the places of all bodies that are on beams.
inline std::vector<int> places_of(const BeamSystem& system) {
  std::vector<int> all;
  for (const MeshRider& tie : system.mesh().riders)
    if (tie.place >= 0) all.push_back(tie.place);
  return all;
}
/// Whether it is carried as a node of the beam.
inline bool is_node(const BeamSystem& system, int body) {
  return system.mesh().riders[tie_of(system.model(), body)].node >= 0;
}
inline const MeshNode& node_of(const BeamSystem& system, int body) {
  const int tie = tie_of(system.model(), body);
  return system.mesh().nodes[system.model().riders[tie].beam][system.mesh().riders[tie].node];
}

/// A stop of a body at a place of its beam, reached from below, and one that keeps two bodies apart.
inline Stop stop_at(const Structure& structure, int body, double s) {
  return {.rider = tie_of(structure, body), .place = s};
}
inline Stop stop_between(const Structure& structure, int body, int next, double gap) {
  return {.rider = tie_of(structure, body), .other = tie_of(structure, next), .place = gap};
}

/// Ends of a connector.
inline auto end_on_body(int body) { return Grip::on_body(body); }
inline auto end_on_beam(int beam, double s) { return Grip::on_beam(beam, s); }
inline auto end_at(const Eigen::Vector3d& point) { return Grip::at_point(point); }

/// Points at which a custom force acts.
inline auto point_on_body(int body) { return Grip::on_body(body); }
inline auto point_on_beam(int beam, double s) { return Grip::on_beam(beam, s); }

}  // namespace nurbeam::testing
