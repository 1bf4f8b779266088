#pragma once
#include <utility>

#include "pipelines/case/fields.h"
#include "pipelines/case/parts/place_motion.h"

namespace nurbeam {

/// Sprung masses above each other that press on a wire from one side, and travel along it: a pantograph.
struct CaseCollector {
  std::string path;
  std::string name, beam;
  Place at;                                              ///< where it begins
  Eigen::Vector3d travel = Eigen::Vector3d::Zero();      ///< in any length
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();         ///< in any length
  std::vector<double> masses;                            ///< from the base up [kg]
  std::vector<double> stiffness, damping;                ///< below each mass [N/m], [N s/m]; none: 0
  TimeTable force = {{0, 0}};                            ///< [N]
  double force_per_speed_squared = 0;                    ///< [N s^2/m^2]
  int force_on = 1;                                      ///< number of the mass, from the base
  CasePlaceMotion motion;                                ///< distance along `travel` since the start [m]
  double contact_stiffness = 50e3, contact_damping = 0;  ///< [N/m], [N s/m]
  std::vector<double> evaluate;            ///< from, to: position along `travel` [m]; empty: all
  double filter = 20;                      ///< of statistics [Hz]
  std::vector<std::vector<double>> bands;  ///< low and high frequencies [Hz]
  std::vector<std::string> uplift;         ///< names of probes
};

inline Fields<CaseCollector> collector_fields() {
  using namespace shapes;
  using C = CaseCollector;
  const auto list = [](Shape item) { return array(std::move(item), 1); };
  const auto pair = [](Shape item) {
    Shape two = array(std::move(item), 2);
    two.most_items = 2;
    return two;
  };
  const Range frequencies{.lower = 0, .upper = 1e6};
  const Shape by_speed =
      object({{"per_speed_squared", quantity(Dimension::number, plausible(-1e9, 1e9)),
               "force per square of the speed, in N s^2/m^2: the lift of the air", required},
              {"offset", constant_or_table(Dimension::force, plausible(-1e12, 1e12)),
               "force at no speed, or that over time; 0 when omitted"}});
  return {
      {
          field(&C::name, "name", name(), "heads its columns, and those of its parts").needed(),
          field(&C::beam, "beam", name(), "the wire that it presses on").needed(),
          field(&C::at, "at", place(), "where it presses at the start").needed(),
          field(&C::travel, "travel", vector(Dimension::number),
                "direction in which it travels; the beam leads that way, or straight back, everywhere")
              .needed(),
          field(&C::up, "up", vector(Dimension::number), "direction in which it presses, across `travel`")
              .otherwise("[0, 0, 1]"),
          field(&C::masses, "masses", list(quantity(Dimension::mass, {.lower = 1e-9, .upper = 1e9})),
                "from the base up; the last is the head. Each moves along `up` alone, and has no weight: "
                "`force` is what is left of the lift")
              .needed(),
          field(&C::stiffness, "stiffness", list(quantity(Dimension::stiffness, plausible(0, 1e16))),
                "of the springs below each mass, the first one to the base; they have no force where all "
                "masses are at the height of the reference wire at the start")
              .needed(),
          field(&C::damping, "damping", list(quantity(Dimension::damping, plausible(0, 1e16))),
                "of the dampers beside the springs; none when omitted"),
          field_by<C>("force", either(constant_or_table(Dimension::force, plausible(-1e12, 1e12)), by_speed),
                      "lift of the mass `force_on`, along `up`: a number, rows over time, or by the speed",
                      [](const Json& json, const std::string&, C& collector, Findings&) {
                        const Json* factor = value_under(json, "per_speed_squared");
                        const Json* offset = value_under(json, "offset");
                        if (factor) take(*factor, collector.force_per_speed_squared);
                        if (!factor && !offset) collector.force.clear();
                        if (!factor && !offset) take(json, collector.force);
                        if (offset) collector.force.clear();
                        if (offset) take(*offset, collector.force);
                      })
              .needed(),
          field(&C::force_on, "force_on", integer({.lower = 1}), "number of that mass, counted from the base")
              .otherwise("1"),
          place_motion_field(&C::motion, "the way along `travel` since the start, from 0 on,",
                             "how it travels")
              .needed(),
          field_by<C>(
              "contact",
              object({{"stiffness", quantity(Dimension::stiffness, positive()),
                       "of the contact between head and wire; 50 kN/m when omitted"},
                      {"damping", quantity(Dimension::damping, plausible(0, 1e16)), "0 when omitted"}}),
              "the force is stiffness times penetration and damping times its rate, and 0 where this would "
              "pull",
              [](const Json& json, const std::string&, C& collector, Findings&) {
                if (const Json* value = value_under(json, "stiffness"))
                  take(*value, collector.contact_stiffness);
                if (const Json* value = value_under(json, "damping")) take(*value, collector.contact_damping);
              }),
          field(&C::evaluate, "evaluate", pair(quantity(Dimension::length, plausible(-1e9, 1e9))),
                "[from, to]: statistics are of its force while the head is there, as a coordinate along "
                "`travel`; of the whole run when omitted"),
          field(&C::filter, "filter", quantity(Dimension::number, {.lower = 0, .upper = 1e6, .open = true}),
                "frequency in Hz up to which statistics take the force, by a Butterworth filter of order 4, "
                "forwards and backwards")
              .otherwise("20"),
          field(&C::bands, "bands", array(pair(quantity(Dimension::number, frequencies))),
                "more statistics: of the force between two frequencies in Hz each, by the same filter"),
          field(&C::uplift, "uplift", array(name()),
                "names of probes whose largest displacement along `up` since the start is reported, as of a "
                "wire at its supports"),
      },
      {}};
}

}  // namespace nurbeam
