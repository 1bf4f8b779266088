#pragma once
#include "pipelines/case/parts/slope.h"

namespace nurbeam {

/// What takes hold of a body, of a place of a beam, or of a point in space.
struct CaseGrip {
  std::string path;
  std::string body;                                ///< later the point of the body, a body of its own
  std::string body_point;                          ///< the name of a point of the body; empty: none
  std::optional<Eigen::Vector3d> body_place = {};  ///< of the body, as drawn [m]
  std::string beam;
  Place at = {};                              ///< on the beam
  std::optional<Eigen::Vector3d> point = {};  ///< in space [m]

  bool is_on_body() const { return !body.empty(); }
};

/// Takes what stands under "at": of a beam its place, of a body the name of a point or a point as drawn.
void take_place(const Json& value, const std::string& path, CaseGrip& grip, Findings& findings);

inline constexpr const char* place_of_grip_help =
    "where on the beam; of a rigid body the name of one of its points, or a point of it in the reference configuration, its centre of mass when omitted";

/// The rows of a grip by itself.
inline Fields<CaseGrip> grip_fields() {
  using namespace shapes;
  const auto take_at = [](const Json& json, const std::string& path, CaseGrip& grip, Findings& findings) {
    take_place(json, path, grip, findings);
  };
  return {{
              field(&CaseGrip::beam, "beam", name(), "a beam, at the position `at`"),
              field(&CaseGrip::body, "body", name(), "a body"),
              field(&CaseGrip::point, "point", point(), "a point that stays where it is"),
              field_by<CaseGrip>("at", place_of_grip(), place_of_grip_help, take_at),
          },
          {{{"beam", "body", "point"}, required}}};
}

}  // namespace nurbeam
