#pragma once
#include "pipelines/case/parts/grip.h"
#include "pipelines/case/parts/rotation.h"

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
  Shape pair = array(grip_fields().shape(), 2);
  pair.most_items = 2;
  Shape axes = array(direction(), 2);
  axes.most_items = 2;
  return {
      {
          field(&J::beams, "beams", array(name(), 2), "the beams that meet"),
          field_by<J>("between", pair,
                      "a rigid body and what it is joined to: another body, a beam or a point in space",
                      [](const Json&, const std::string&, J&, Findings&) {}),
          field_by<J>(
              "type", choice({"hinged", "rigid", "universal", "cylinder", "slide"}),
              "rigid: the angle between them stays; hinged: a ball, or with `axis` a pin; of bodies also "
              "universal: two `axes` stay square; cylinder: turns about `axis` and slides along it; slide: "
              "slides along `axis` alone",
              [](const Json& json, const std::string&, J& joint, Findings&) {
                joint.rigid = text_of_choice(json) == "rigid";
              })
              .needed(),
          field_by<J>("at", object({{"near", point(), "a point near the joint", required}}),
                      "where, if not at an end of one of them",
                      [](const Json& json, const std::string&, J& joint, Findings&) {
                        if (const Json* near = value_under(json, "near")) take(*near, joint.near);
                      }),
          field(
              &J::axis, "axis", vector(Dimension::number),
              "in the reference configuration, of a hinge between beams with torsion or of a rigid body, which turn about it alone; of "
              "what slides its direction"),
          field_by<J>(
              "axes", axes,
              "of a universal joint: one of the first body, one of what it is joined to, in the reference configuration",
              [](const Json&, const std::string&, J&, Findings&) {}),
          field_by<J>(
              "drive", drive_fields().shape(),
              "of a \"hinged\" joint of a rigid body with an `axis`: what turns the first body named in "
              "`between` about the axis, against what it is joined to",
              [](const Json&, const std::string& path, J&, Findings& findings) {
                findings.error(path,
                               "is of a hinge of a rigid body, by \"between\"; of beams turn a "
                               "support by its \"rotation\"");
              }),
          slope_field(&J::slope),
          field(&J::name, "name", name(), "heads the columns of its forces"),
      },
      {{{"beams", "between"}, required}}};
}

}  // namespace nurbeam
