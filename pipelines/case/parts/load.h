#pragma once
#include "pipelines/case/parts/grip.h"

namespace nurbeam {

struct CaseLoad {
  enum class Kind {
    force,
    moment,
    force_per_length,
    force_per_projected_length,
    torque_per_length
  } kind = Kind::force;
  std::string path;
  int number = 0;                                   ///< among the loads of the case
  std::string beam, body;                           ///< one of them
  Place at;                                         ///< for force and moment
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< [N], [N m] or [N/m]
  double torque = 0;                                ///< per length [N m/m]
  std::optional<Eigen::Vector2d> offset;            ///< of a force from the axis [m]
  bool follower = false;
  std::optional<double> moving_speed;      ///< along the beam from `at` [m/s]
  TimeTable time;                          ///< factor; empty: 1
  SlopeRule slope = SlopeRule::automatic;  ///< where a force acts
};

inline Fields<CaseLoad> load_fields() {
  using namespace shapes;
  using L = CaseLoad;
  const auto value = [](const char* key, Dimension dimension, L::Kind kind, const char* help) {
    return field_by<L>(key, vector(dimension, plausible(-1e12, 1e12)), help,
                       [kind](const Json& json, const std::string&, L& load, Findings&) {
                         load.kind = kind;
                         take(json, load.value);
                       });
  };
  const Shape moves =
      object({{"speed", quantity(Dimension::speed, plausible(-1e9, 1e9)), "speed along the beam", required}});
  return {
      {
          field(&L::beam, "beam", name(), "the loaded beam"),
          field(&L::body, "body", name(),
                "the loaded body, which may turn with a moment where it is a rigid one"),
          field_by<L>(
              "at", place_of_grip(),
              "where the force or moment acts; a force on a rigid body: the name of one of its points, or "
              "its reference position; the centre of mass when omitted",
              [](const Json& json, const std::string& path, L& load, Findings& findings) {
                CaseGrip grip{.body = load.body, .beam = load.beam};
                take_place(json, path, grip, findings);
                load.at = grip.at;
              }),
          value("force", Dimension::force, L::Kind::force, "point force, fixed in space"),
          value("moment", Dimension::moment, L::Kind::moment, "point moment"),
          value("force_per_length", Dimension::force_per_length, L::Kind::force_per_length,
                "per metre of reference arc length"),
          value("force_per_projected_length", Dimension::force_per_length,
                L::Kind::force_per_projected_length,
                "per metre of the reference curve, projected along the force: snow and ice by the length in "
                "plan"),
          field_by<L>("torque_per_length", quantity(Dimension::torque_per_length, plausible(-1e12, 1e12)),
                      "about the tangent of a beam with torsion, per metre of reference arc length",
                      [](const Json& json, const std::string&, L& load, Findings&) {
                        load.kind = L::Kind::torque_per_length;
                        take(json, load.torque);
                      }),
          field(&L::offset, "offset", offset(),
                "[x, y] of where the force acts, from the axis along the axes of the section of a beam with "
                "torsion")
              .beside("force"),
          field(&L::follower, "follower", boolean(), "force or moment turns with the section")
              .otherwise("false"),
          field_by<L>("moves", moves, "a force that moves along the beam",
                      [](const Json& json, const std::string&, L& load, Findings&) {
                        if (const Json* speed = value_under(json, "speed")) take(*speed, load.moving_speed);
                      })
              .beside("force"),
          slope_field(&L::slope).beside("force"),
          field(&L::time, "time", table(Dimension::number, {.lower = -1e12, .upper = 1e12}),
                "factor over time, linear between rows, constant outside"),
      },
      {{{"beam", "body"}, required},
       {{"force", "moment", "force_per_length", "force_per_projected_length", "torque_per_length"}, required},
       {{"at", "force_per_length", "force_per_projected_length", "torque_per_length"}, false}}};
}

}  // namespace nurbeam
