#pragma once
#include "fem/structure/structure.h"
#include "pipelines/case/parts/friction.h"
#include "pipelines/case/parts/place_motion.h"

namespace nurbeam {

/// A drum or a spool at an end of a beam, which takes the beam in and pays it out.
struct CaseReel {
  std::string path;
  std::string name, beam;
  bool at_start = true;
  double stored = 0;  ///< [m]
  Reel::Feed feed = Reel::Feed::drum;
  std::optional<double> pickup = {};               ///< of a spool
  double inertia = 0;                              ///< I/r^2 of the empty drum [kg]
  std::vector<DisplacementTable::Row> moves = {};  ///< places over time [m]; empty: it stands
  std::string on;                                  ///< the body that carries it; empty: none
  CasePlaceMotion motion = {};                     ///< length paid out [m]
  TimeTable force = {};                            ///< with which it takes in [N]
  std::optional<Friction> friction = {};
  double stored_tension = 0;  ///< [N]
  bool leave_at_empty = false;
  std::optional<Eigen::Vector3d> direction = {};  ///< of its mouth
};

inline Fields<CaseReel> reel_fields() {
  using namespace shapes;
  using R = CaseReel;
  return {
      {
          field(&R::name, "name", name(), "heads its columns").needed(),
          field(&R::beam, "beam", name(), "the beam that it takes in and pays out").needed(),
          choice_field(&R::at_start, "end", {{"start", true}, {"end", false}},
                       "the end of the beam at which it is")
              .needed(),
          field(&R::stored, "stored", quantity(Dimension::length, plausible(0, 1e6)),
                "unstressed length on it at the start, in addition to the reference curve")
              .needed(),
          choice_field(
              &R::feed, "feed", {{"drum", Reel::Feed::drum}, {"spool", Reel::Feed::spool}},
              "drum: it turns with its rope, at the speed at which that leaves; spool: rope at rest is "
              "drawn off over its end, and not taken in again")
              .otherwise("drum"),
          field(&R::pickup, "pickup", quantity(Dimension::number, {.lower = 0.5, .upper = 100}),
                "of a spool: rope that is drawn off at a speed v has the tension pickup times its mass per "
                "length "
                "times v squared; 0.5 loses no energy; 1 when omitted"),
          field(&R::inertia, "inertia", quantity(Dimension::mass, plausible(0, 1e12)),
                "of the empty drum: its moment of inertia over the square of its radius")
              .otherwise("0"),
          field(&R::moves, "path", vector_table(Dimension::length, plausible(-1e9, 1e9)),
                "moves it: rows [time, x, y, z] of where it is; smooth between them, with a continuous speed "
                "and acceleration, at rest at the first and the last; it stands when omitted"),
          field(&R::on, "on", name(), "the body that carries it, whose `mass` is without rope"),
          place_motion_field(&R::motion, "the length that it has paid out, from 0 on",
                             "prescribed motion, positive where it pays out"),
          field(
              &R::force, "force", constant_or_table(Dimension::force, plausible(-1e12, 1e12)),
              "with which it takes in, or that over time: the torque of a motor over the radius of the drum"),
          field_by<R>("friction", friction_fields().shape(),
                      "its brake; `coefficient` is of the force of the beam on it; nothing when omitted",
                      [](const Json& json, const std::string& path, R& reel, Findings& findings) {
                        reel.friction = Friction{.law = Friction::Law::bearing};
                        friction_fields().read(json, path, *reel.friction, findings);
                      }),
          field(&R::stored_tension, "stored_tension", quantity(Dimension::force, plausible(0, 1e12)),
                "with which the beam is wound on it")
              .otherwise("0"),
          choice_field(
              &R::leave_at_empty, "at_empty", {{"stop", false}, {"leave", true}},
              "when nothing is left on it: stop: the beam's end is tied to it; leave: the end comes off")
              .otherwise("stop"),
          field(&R::direction, "direction", vector(Dimension::number),
                "of a mouth that also fixes the direction of the beam, as a tube does: along the beam, "
                "towards its end; free when omitted"),
      },
      {{{"path", "on"}, false}, {{"motion", "force"}, false}}};
}

}  // namespace nurbeam
