#pragma once
#include "pipelines/case/parts/slope.h"

namespace nurbeam {

/// Beams that meet at one place.
struct CaseBeamJoint {
  std::string name;  ///< heads the columns of its forces; may be empty
  std::string path;
  std::vector<std::string> beams;            ///< two or more; each is joined to the first
  bool rigid = false;                        ///< else hinged
  std::optional<Eigen::Vector3d> near = {};  ///< where [m]; else where an end of one meets the other
  std::optional<Eigen::Vector3d> axis = {};  ///< of a hinge
  SlopeRule slope = SlopeRule::automatic;    ///< of the beams where they go on beyond it
};

inline Fields<CaseBeamJoint> beam_joint_fields() {
  using namespace shapes;
  using J = CaseBeamJoint;
  return {{
      field(&J::beams, "beams", array(name(), 2), "the beams that meet").needed(),
      choice_field(&J::rigid, "type", {{"hinged", false}, {"rigid", true}},
                   "rigid: the angle between them stays")
          .needed(),
      field_by<J>("at", object({{"near", point(), "a point near the joint", required}}),
                  "where, if not at an end of one of them",
                  [](const Json& json, const std::string&, J& joint, Findings&) {
                    if (const Json* near = value_under(json, "near")) take(*near, joint.near);
                  }),
      field(&J::axis, "axis", vector(Dimension::number),
            "as drawn, of a hinge between beams with torsion, which turn about it alone"),
      slope_field(&J::slope),
      field(&J::name, "name", name(), "heads the columns of its forces"),
  }};
}

}  // namespace nurbeam
