#pragma once
#include "pipelines/case/fields.h"

namespace nurbeam {

struct CaseBody {
  std::string name;
  double mass = 0;          ///< [kg]
  double roll_inertia = 0;  ///< of one that follows a section [kg m^2]
  double drag_area = 0;     ///< C_d A [m^2]
  std::string path = {};
  std::string fastened_to;                             ///< the beam to which it is fastened; empty: none
  Place fastened_at = {};                              ///< where on it
  std::optional<Eigen::Vector3d> position = {};        ///< of one that no sliding joint places [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< likewise [m/s]
};

inline Fields<CaseBody> body_fields() {
  using namespace shapes;
  using B = CaseBody;
  const Range mass{
      .lower = 1e-9,
      .upper = 1e12,
      .reason = "a body without mass has no inertia; what lies outside is most likely in another unit"};
  return {{
      field(&B::name, "name", name(), "name of the body").needed(),
      field(&B::mass, "mass", quantity(Dimension::mass, mass), "mass").needed(),
      field(&B::roll_inertia, "roll_inertia", quantity(Dimension::inertia, plausible(0, 1e16)),
            "about the beam, of a body that follows its section")
          .otherwise("0"),
      field(&B::drag_area, "drag_area", quantity(Dimension::area, plausible(0, 1e6)),
            "drag coefficient times area, of the drag of the `air`")
          .otherwise("0"),
      field(&B::position, "position", point(), "where a body without a sliding joint starts"),
      field_by<B>(
          "fastened",
          object({{"beam", name(), "the beam", required}, {"at", place(), "which place of it", required}}),
          "a weight that goes with a place of a beam, as at a rope's end",
          [](const Json& json, const std::string&, B& body, Findings&) {
            if (const Json* beam = value_under(json, "beam")) take(*beam, body.fastened_to);
            if (const Json* at = value_under(json, "at")) take(*at, body.fastened_at);
          }),
      field(&B::velocity, "velocity", vector(Dimension::speed, plausible(-1e9, 1e9)),
            "how fast it starts; at rest when omitted")
          .beside("position"),
  }};
}

}  // namespace nurbeam
