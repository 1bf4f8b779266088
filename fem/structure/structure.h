#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fem/structure/air.h"
#include "fem/structure/beam.h"
#include "fem/structure/connector.h"
#include "fem/structure/friction.h"
#include "fem/structure/mass_field.h"
#include "fem/structure/place_motion.h"
#include "fem/structure/reel.h"
#include "fem/structure/rigid_body.h"
#include "fem/structure/rotational_connector.h"
#include "fem/structure/stop.h"
#include "fem/time_table.h"

namespace nurbeam {

/// A point mass with coordinates of its own, on no beam, on one, or where two beams cross; a rigid body, or a
/// place of one.
struct Body {
  std::string name;
  double mass;  ///< [kg]
  /// Position and velocity at the start, when no rider gives them [m], [m/s].
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();
  double roll_inertia = 0;  ///< about the tangent of a section that it follows [kg m^2]
  double drag_area = 0;     ///< C_d A, of the drag of the air [m^2]
  std::optional<RigidBody> rigid = {};
  std::optional<BodyPoint> point_of = {};  ///< the rigid body that carries it, a point without mass
};

/// The treatment of a sliding body in a search for the static equilibrium.
enum class StaticPlace {
  automatic,  ///< in a static analysis the body slides to where it rests; before a motion it is held where it
              ///< is
  held,
  free,
  free_or_held  ///< free; held before a motion for which no rest is found with it free
};

/// What of the attitude of a rigid body goes with the section of the beam at its point.
enum class Follows {
  nothing,
  axis,     ///< an axis of the body keeps its direction in the section
  tangent,  ///< an axis of the body stays along the beam
  section   ///< all of it
};

/// A rider ties a body to a moving place on a beam.
struct Rider {
  int body;
  int beam;
  double s;                            ///< reference arc length at t = 0 [m]
  double speed = 0;                    ///< at t = 0 [m/s]
  std::optional<PlaceMotion> motion;   ///< prescribed s(t)
  std::optional<double> release = {};  ///< the place is held at s until this time [s]
  bool continuous_slope = true;
  bool leave_at_end = true;  ///< false: the body stops at the end
  /// For a beam with torsion: the body rolls with the section at its place, at the offset along d1 and d2
  /// from the axis [m].
  bool follows_section = false;
  bool sharp = false;  ///< as HomeNode::sharp, where the slope is continuous
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();

  Follows follows = Follows::nothing;
  Eigen::Vector3d follow_axis = Eigen::Vector3d::UnitX();  ///< as the bodies start, for Follows::axis

  StaticPlace rest = StaticPlace::automatic;
  std::optional<Friction> friction = {};
  bool as_point = false;  ///< carried as a point of a fixed mesh, at every place
  /// I/r^2 of a pulley that turns as the beam runs over it: inertia against a change of the place [kg]
  double turning_inertia = 0;
  TimeTable drive_force = {};  ///< on the body towards greater s, from the beam [N]; empty: none
  /// A sleeve holds the beam's direction too; the rider has one slope, and is a node there [-].
  std::optional<Eigen::Vector3d> direction = {};
  std::optional<Reel> reel = {};  ///< the rider is the mouth of a reel, always a node: the end of its beam

  bool is_offset() const { return follows_section && offset != Eigen::Vector2d::Zero(); }
  /// Whether a body carried as a node has coordinates besides those of the node: a constraint then ties both,
  /// and its multipliers are the force between them.
  bool stands_apart() const { return is_offset() || friction.has_value(); }
};

/// All that has coordinates: beams, bodies, riders, connectors of both kinds and stops.
struct Structure {
  int dimension = 3;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s^2]
  Air air = {};
  std::optional<MassField> field = {};  ///< what acts on mass besides gravity
  bool runs_at_rest = false;  ///< its equilibria are those of beams that run along themselves (Beam::flow)
  std::vector<Beam> beams;
  std::vector<Body> bodies;
  std::vector<Rider> riders;
  std::vector<Connector> connectors;
  std::vector<Stop> stops;
  std::vector<RotationalConnector> rotational_connectors;

  const Beam& beam_of(const Rider& rider) const { return beams[rider.beam]; }
  const Body& body_of(const Rider& rider) const { return bodies[rider.body]; }
  /// The rigid body that a rider carries, by its centre or by a place of it; -1 for a point mass.
  int turning_body(const Rider& rider) const {
    const Body& body = body_of(rider);
    return body.rigid ? rider.body : body.point_of ? body.point_of->body : -1;
  }
  /// Reference length on the reel of a rider whose mouth is at s [m].
  double stored_length(const Rider& rider, double s) const {
    const ReferenceCurve& curve = beam_of(rider).curve;
    return rider.reel->at_start ? s - curve.start() : curve.end() - s;
  }
  /// Stiffness of the stick of a rider with friction [N/m].
  double stick_stiffness(const Rider& rider) const {
    const Beam& beam = beam_of(rider);
    return rider.friction->stick_stiffness.value_or(
        beam.rigid ? Friction::stiffness_on_guide(body_of(rider).mass)
                   : beam.properties.stiffness_of_length(beam.curve.length() / beam.home_intervals()));
  }
};

}  // namespace nurbeam
