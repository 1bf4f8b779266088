#pragma once
#include <numbers>

#include "fem/structure/connector.h"
#include "pipelines/case/fields.h"
#include "pipelines/case/force_laws.h"
#include "pipelines/case/parts/grip.h"

namespace nurbeam {

/// What a connector is fastened to: one of these.
struct CaseConnectorEnd : CaseGrip {
  SlopeRule slope = SlopeRule::automatic;  ///< of the beam
};

struct CaseConnector {
  std::string path, name;
  std::array<CaseConnectorEnd, 2> ends;
  ConnectorType type = ConnectorType::spring;
  /// Resists a turn of its ends instead of their distance; then stiffness and damping are in [N m/rad] and
  /// [N m s/rad].
  bool rotational = false;
  std::optional<Eigen::Vector3d> axis = {};  ///< of a rotational one
  double angle = 0, moment = 0;              ///< free angle [rad]; moment at it [N m]
  double stiffness = 0, damping = 0;         ///< [N/m], [N s/m]
  std::optional<ForceRows> rows = {};        ///< instead of a constant stiffness
  ConnectorLength length_rule = ConnectorLength::given;
  std::optional<double> length = {};  ///< where it is given; else that of the drawing [m]
  double force = 0;                   ///< with ConnectorLength::force [N]
  std::optional<Eigen::Vector3d> direction = {};
  std::array<double, 2> end_masses = {0, 0};  ///< [kg]
};

inline Fields<CaseConnectorEnd> connector_end_fields() {
  using namespace shapes;
  using E = CaseConnectorEnd;
  // Members of its base, as its own.
  std::string E::*const beam = &E::beam, E::*const body = &E::body;
  std::optional<Eigen::Vector3d> E::*const fixed = &E::point;
  return {{
              field(beam, "beam", name(), "a beam, at the position `at`"),
              slope_field(&E::slope).beside("beam"),
              field(body, "body", name(), "a body"),
              field(fixed, "point", point(), "a point that stays where it is"),
              field_by<E>("at", place_of_grip(), place_of_grip_help,
                          [](const Json& json, const std::string& path, E& end, Findings& findings) {
                            take_place(json, path, end, findings);
                          }),
          },
          {{{"beam", "body", "point"}, required}}};
}

inline Fields<CaseConnector> connector_fields() {
  using namespace shapes;
  using C = CaseConnector;
  const auto end = [](int i) {
    return [i](const Json& json, const std::string& path, C& connector, Findings& findings) {
      connector.ends[i].path = path;
      connector_end_fields().read(json, path, connector.ends[i], findings);
    };
  };
  Shape masses = array(quantity(Dimension::mass, plausible(0, 1e12)), 2);
  masses.most_items = 2;
  return {
      {
          field(&C::name, "name", name(), "heads the columns of its force and length").needed(),
          field_by<C>("from", connector_end_fields().shape(), "its first end", end(0)).needed(),
          field_by<C>("to", connector_end_fields().shape(), "its second end", end(1)).needed(),
          field_by<C>("type", choice({"spring", "tension-only", "compression-only", "rod", "rotational"}),
                      "tension-only: a dropper or a rope, slack where it is shorter than its free length; "
                      "compression-only: the other way; rod: it keeps its length; rotational: it resists the "
                      "turn of its second end against the first, or against space where one is a point",
                      [](const Json& json, const std::string&, C& connector, Findings&) {
                        const std::string type = text_of_choice(json);
                        connector.rotational = type == "rotational";
                        connector.type = type == "tension-only"       ? ConnectorType::tension_only
                                         : type == "compression-only" ? ConnectorType::compression_only
                                         : type == "rod"              ? ConnectorType::rod
                                                                      : ConnectorType::spring;
                      })
              .otherwise("spring"),
          field_by<C>(
              "stiffness",
              either(quantity(Dimension::stiffness, plausible(0, 1e16)),
                     rows_over("stretch", Dimension::length, Dimension::force, plausible(-1e12, 1e12))),
              "force per stretch, or rows of stretch and force, both of which increase: smooth between "
              "the rows, straight beyond them; of a rotational one the moment per radian, in N m/rad",
              [](const Json& json, const std::string& path, C& connector, Findings& findings) {
                if (is_number(json))
                  take(json, connector.stiffness);
                else if ((connector.rows = force_rows(json, path, findings)))
                  connector.stiffness = connector.rows->at(0).stiffness;
              })
              .measured_where("type", "rotational", Dimension::rotational_stiffness),
          field(&C::damping, "damping", quantity(Dimension::damping, plausible(0, 1e16)),
                "force per speed of the stretch; of a rotational one in N m s/rad")
              .otherwise("0")
              .beside("stiffness")
              .measured_where("type", "rotational", Dimension::rotational_damping),
          field_by<C>(
              "length", either(choice({"drawn", "as-drawn"}), quantity(Dimension::length, plausible(0, 1e9))),
              "free length, of a rod its length; drawn: the distance of its ends in the reference configuration; as-drawn: that for which its first end has its reference position in equilibrium; drawn when "
              "omitted",
              [](const Json& json, const std::string&, C& connector, Findings&) {
                if (is_number(json))
                  take(json, connector.length);
                else if (text_of_choice(json) == "as-drawn")
                  connector.length_rule = ConnectorLength::as_drawn;
              }),
          field_by<C>(
              "force", quantity(Dimension::force, plausible(-1e12, 1e12)),
              "force at the start, in statics under the full loads, positive where it pulls, which gives "
              "the free length",
              [](const Json& json, const std::string&, C& connector, Findings&) {
                take(json, connector.force);
                connector.length_rule = ConnectorLength::force;
              }),
          field(
              &C::direction, "direction", vector(Dimension::number),
              "it acts along this direction alone, on the distance along it from the first end to the second"),
          field(
              &C::axis, "axis", vector(Dimension::number),
              "of a rotational one: the axis, by the right hand, about which its angle is counted, over full "
              "turns; in space it may be left out between sections of beams with torsion, and any turn is "
              "then resisted, up to 170 degrees"),
          field_by<C>("angle", quantity(Dimension::angle, plausible(-1e9, 1e9)),
                      "of a rotational one: the angle since the drawing where it is free",
                      [](const Json& json, const std::string&, C& connector, Findings&) {
                        take(json, connector.angle);
                        connector.angle *= std::numbers::pi / 180;
                      })
              .otherwise("0"),
          field(&C::moment, "moment", quantity(Dimension::moment, plausible(-1e12, 1e12)),
                "of a rotational one: a moment besides, positive where it turns the second end back")
              .otherwise("0"),
          field(&C::end_masses, "end_masses", masses,
                "[kg, kg] lumped at its ends, as of clamps; none when omitted"),
      },
      {{{"length", "force"}, false}}};
}

}  // namespace nurbeam
