#pragma once
#include "fem/structure/stop.h"
#include "pipelines/case/fields.h"

namespace nurbeam {

/// What keeps bodies on one side of a place of a beam, or two bodies apart.
struct CaseStop {
  enum class Side { both, before, after };
  std::string path;
  std::string beam;
  std::optional<Place> at;          ///< of one that stands on the beam
  std::vector<std::string> bodies;  ///< those that it stops; empty: all on the beam
  Side side = Side::both;           ///< from where it stops bodies
  double restitution = 0;
  std::optional<Buffer> buffer = {};
  double gap = 0;  ///< between two bodies [m]
};

inline Fields<CaseStop> stop_fields() {
  using namespace shapes;
  using S = CaseStop;
  const auto buffer = [](double Buffer::*member) {
    return [member](const Json& json, const std::string&, S& stop, Findings&) {
      if (!stop.buffer) stop.buffer.emplace();
      take(json, (*stop.buffer).*member);
    };
  };
  return {{
              field(&S::beam, "beam", name(), "the beam on which bodies meet it").needed(),
              field(&S::at, "at", place(),
                    "its position on the beam; without it, it is between the two `bodies`"),
              field(&S::bodies, "bodies", array(name(), 1),
                    "the bodies that it stops, or the two that it separates; all on the beam when omitted"),
              choice_field(&S::side, "side",
                           {{"both", S::Side::both}, {"before", S::Side::before}, {"after", S::Side::after}},
                           "stops bodies that come from before it (lesser s), from after it, or both")
                  .otherwise("both")
                  .beside("at"),
              field(&S::gap, "gap", quantity(Dimension::length, not_negative()),
                    "minimum distance of the two bodies along the beam")
                  .otherwise("0"),
              field(&S::restitution, "restitution", quantity(Dimension::number, {.lower = 0, .upper = 1}),
                    "of a hard stop: speed after over speed before an impact")
                  .otherwise("0"),
              field_by<S>("stiffness", quantity(Dimension::force_per_length, plausible(1e-9, 1e16)),
                          "of a buffer: force over how far it is pressed in", buffer(&Buffer::stiffness)),
              field_by<S>("damping", quantity(Dimension::damping, plausible(0, 1e16)),
                          "of a buffer: force over the speed of that", buffer(&Buffer::damping))
                  .otherwise("0")
                  .beside("stiffness"),
          },
          {{{"restitution", "stiffness"}, false}, {{"at", "gap"}, false}}};
}

}  // namespace nurbeam
