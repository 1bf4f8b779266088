#pragma once
#include "fem/structure/structure.h"
#include "pipelines/case/parts/friction.h"
#include "pipelines/case/parts/place_motion.h"
#include "pipelines/case/parts/slope.h"
#include "pipelines/case/parts/support.h"

namespace nurbeam {

struct CaseSlidingJoint {
  std::string path;
  std::string body, beam;
  std::string point;  ///< of the body; empty: none
  Place at;
  std::optional<double> speed;    ///< initial [m/s]
  CasePlaceMotion motion;         ///< prescribed ds/dt [m/s] or s(t) [m]
  std::optional<double> release;  ///< held until then [s]
  SlopeRule slope = SlopeRule::automatic;
  bool leave_at_end = true;  ///< false: stop
  bool follows_section = false;
  Follows follows = Follows::nothing;
  std::optional<Eigen::Vector3d> axis = {};    ///< of Follows::axis, as drawn
  double rolling_mass = 0;                     ///< [kg]
  std::optional<Eigen::Vector2d> offset = {};  ///< in the section that it follows [m]
  StaticPlace rest = StaticPlace::automatic;
  std::optional<Friction> friction = {};
  std::optional<int> motion_law = {};  ///< the function of a program that prescribes it
  bool as_point = false;               ///< the mesh stays as it is where the body is

  bool says_speed() const { return speed || motion.is_given() || release || motion_law; }
};

inline Fields<CaseSlidingJoint> sliding_joint_fields() {
  using namespace shapes;
  using J = CaseSlidingJoint;
  Fields<J> fields{
      {
          field(&J::body, "body", name(), "the sliding body").needed(),
          field(&J::point, "point", name(),
                "the point of a rigid body that slides; its centre of mass when omitted"),
          field(&J::beam, "beam", name(), "the beam it slides on").needed(),
          field(&J::at, "at", place(), "where it starts").needed(),
          field(
              &J::speed, "speed", quantity(Dimension::speed, plausible(-1e9, 1e9)),
              "initial speed in reference arc length; when omitted that of the body by its joint on another "
              "beam, else 0"),
          place_motion_field(&J::motion, "reference arc length",
                             "prescribed motion of the body, from `at` on"),
          choice_field(
              &J::rest, "equilibrium", {{"held", StaticPlace::held}, {"free", StaticPlace::free}},
              "the body in statics: locked at its `at`, or free; when omitted free in a static analysis, "
              "locked at the start of a motion"),
          field(&J::release, "release", quantity(Dimension::time, positive()),
                "time of a motion until which the body is locked; free from the start when omitted"),
          slope_field(&J::slope),
          choice_field(
              &J::as_point, "carried_as", {{"node", false}, {"point", true}},
              "node: a node of the beam moves with the body, and elements beside it come and go; point: the "
              "body runs through elements that stay")
              .otherwise("node"),
          choice_field(
              &J::follows, "follows",
              {{"nothing", Follows::nothing},
               {"axis", Follows::axis},
               {"tangent", Follows::tangent},
               {"section", Follows::section}},
              "what of a rigid body's attitude follows the section of the beam or rigid curve under it: an "
              "`axis` of the body that keeps its direction there, as of a bogie's pivot; tangent: it hangs "
              "along the beam and swings sideways; section: all of it")
              .otherwise("nothing"),
          field(&J::axis, "axis", direction(),
                "of the body, in the reference configuration, for \"follows\": \"axis\"")
              .beside("follows"),
          field(&J::rolling_mass, "rolling_mass", quantity(Dimension::mass, plausible(0, 1e12)),
                "of wheels that roll as it moves: the sum of their moments of inertia over the squares of "
                "their radii")
              .otherwise("0"),
          field(&J::follows_section, "follows_section", boolean(),
                "the body rolls with the section of a beam with torsion where it is")
              .otherwise("false"),
          field(&J::offset, "offset", offset(),
                "[x, y] of the body from the axis, along the axes of the section that it follows")
              .beside("follows_section"),
          field_by<J>("friction", friction_fields().shape(),
                      "what resists the body that slides; nothing when omitted",
                      [](const Json& json, const std::string& path, J& joint, Findings& findings) {
                        friction_fields().read(json, path, joint.friction.emplace(), findings);
                      }),
          choice_field(&J::leave_at_end, "at_beam_end", {{"leave", true}, {"stop", false}},
                       "what happens at the beam's end; leave when omitted; at a supported end a body stops"),
          field(&J::motion_law, "motion_law", integer(from(0)), motion_law_help),
      },
      {{{"speed", "motion", "release"}, false}}};
  fields.rows.back().in_files = false;
  return fields;
}

}  // namespace nurbeam
