#pragma once
#include "fem/structure/structure.h"
#include "pipelines/case/parts/friction.h"
#include "pipelines/case/parts/place_motion.h"

namespace nurbeam {

/// A ring through which a beam runs: in space, on a path, or on a body.
struct CaseEyelet {
  std::string path;
  std::string name, beam;
  Place at;
  std::optional<Eigen::Vector3d> position = {};    ///< [m]; else where the beam is drawn
  std::vector<DisplacementTable::Row> moves = {};  ///< places over time [m]; empty: it stands
  std::string on;                                  ///< the body that carries it; empty: none
  double inertia = 0;                              ///< I/r^2 of a pulley [kg]
  CasePlaceMotion motion = {};                     ///< length that has passed towards the beam's start [m]
  TimeTable force = {};                            ///< towards the beam's start, on the beam [N]
  std::optional<double> release = {};              ///< the beam is held until then [s]
  bool continuous_slope = false;
  std::optional<Eigen::Vector3d> direction = {};  ///< of a sleeve
  StaticPlace rest = StaticPlace::free_or_held;
  bool leave_at_end = true;  ///< false: stop
  std::optional<Friction> friction = {};
};

inline Fields<CaseEyelet> eyelet_fields() {
  using namespace shapes;
  using E = CaseEyelet;
  return {
      {
          field(&E::name, "name", name(), "heads the columns of its force and of the beam's position in it")
              .needed(),
          field(&E::beam, "beam", name(), "the beam that runs through it").needed(),
          field(&E::at, "at", place(), "position of the beam that is in it at the start").needed(),
          field(&E::position, "position", point(),
                "its position, as a ring without mass; that of the reference curve when omitted"),
          field(&E::moves, "path", vector_table(Dimension::length, plausible(-1e9, 1e9)),
                "moves it: rows [time, x, y, z] of where it is; smooth between them, with a continuous speed "
                "and acceleration, at rest at the first and the last"),
          field(&E::on, "on", name(),
                "the body on which it is: a movable pulley; several eyelets on one body are a block"),
          field(
              &E::inertia, "inertia", quantity(Dimension::mass, plausible(0, 1e12)),
              "of a pulley that turns as the beam runs over it: its moment of inertia over the square of its "
              "radius")
              .otherwise("0"),
          place_motion_field(
              &E::motion, "the length of beam that has passed towards its start, from 0 on",
              "prescribed motion of the beam through it, positive towards the start of the beam, as of a "
              "capstan winch"),
          field(
              &E::force, "force", constant_or_table(Dimension::force, plausible(-1e12, 1e12)),
              "force of a motor towards the start of the beam, or that over time: torque over the radius of "
              "the pulley"),
          field(&E::release, "release", quantity(Dimension::time, positive()),
                "time of a motion until which the beam is locked in it; free from the start when omitted"),
          choice_field(&E::continuous_slope, "slope", {{"continuous", true}, {"discontinuous", false}},
                       "whether the slope of the beam may jump in it")
              .otherwise("discontinuous"),
          field(&E::direction, "direction", vector(Dimension::number),
                "of a sleeve, which also fixes the direction of the beam: along the beam, towards its end; a "
                "ring leaves it free"),
          choice_field(
              &E::rest, "equilibrium", {{"held", StaticPlace::held}, {"free", StaticPlace::free}},
              "the beam in statics: locked with the position `at` in it, or free to run through it; when "
              "omitted free, and locked before a motion without an equilibrium"),
          field_by<E>(
              "friction", friction_fields().shape(),
              "what resists the beam that runs through it; nothing when omitted; `law` is capstan when "
              "omitted, and `stick_stiffness` EA over the length of an element",
              [](const Json& json, const std::string& path, E& eyelet, Findings& findings) {
                eyelet.friction = Friction{.law = Friction::Law::capstan};
                friction_fields().read(json, path, *eyelet.friction, findings);
              }),
          choice_field(&E::leave_at_end, "at_beam_end", {{"leave", true}, {"stop", false}},
                       "what happens when the beam's end comes to it")
              .otherwise("leave"),
      },
      {{{"position", "path", "on"}, false}, {{"motion", "force", "release"}, false}}};
}

}  // namespace nurbeam
