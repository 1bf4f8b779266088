#pragma once
#include "pipelines/case/parts/grip.h"
#include "pipelines/case/parts/rotation.h"

namespace nurbeam {

struct CaseSupport {
  enum class Type { clamped, pinned, fork, guided } type = Type::pinned;
  std::string name;  ///< heads the columns of its reaction; may be empty
  std::string path;
  std::string beam, body;  ///< one of them
  Place at;
  std::vector<DisplacementTable::Row> motion = {};  ///< from the drawn place [m]; empty: none
  RowJoin motion_join = RowJoin::smooth_at_rest;
  std::optional<Eigen::Vector3d> axis = {};       ///< of a hinge
  std::optional<Eigen::Vector3d> direction = {};  ///< where it is free: of a guided one, of one that slides
  double force = 0, mass = 0;                     ///< along it [N], [kg]
  std::optional<CaseRotation> rotation = {};
  SlopeRule slope = SlopeRule::automatic;
  std::optional<int> motion_law = {};  ///< the function of a program that prescribes it
};

/// A function of the program that has made the case, by its number.
inline constexpr const char* motion_law_help = "number of the function that prescribes the motion";

inline Fields<CaseSupport> support_fields() {
  using namespace shapes;
  using S = CaseSupport;
  Fields<S> fields{
      {
          field(&S::beam, "beam", name(), "the supported beam"),
          field(&S::body, "body", name(), "the supported body"),
          field_by<S>(
              "at", place_of_grip(),
              "where; of a rigid body the name of one of its points, or a point of it in the reference configuration, its centre of mass when omitted",
              [](const Json& json, const std::string& path, S& support, Findings& findings) {
                CaseGrip grip{.body = support.body, .beam = support.beam};
                take_place(json, path, grip, findings);
                support.at = grip.at;
              }),
          choice_field(
              &S::type, "type",
              {{"clamped", S::Type::clamped},
               {"pinned", S::Type::pinned},
               {"fork", S::Type::fork},
               {"guided", S::Type::guided}},
              "clamped: position and direction are fixed, with torsion the section; pinned: the position; fork: "
              "position and roll of a beam with torsion; guided: the position but along `direction`, where it is "
              "free")
              .needed(),
          field(
              &S::direction, "direction", vector(Dimension::number),
              "where the support is free: of a guided one; of a clamp or a fork that slides, which holds all else"),
          field(&S::force, "force", quantity(Dimension::force, plausible(-1e12, 1e12)),
                "pulls along `direction`, as a weight over a pulley does")
              .otherwise("0")
              .beside("direction"),
          field(&S::mass, "mass", quantity(Dimension::mass, plausible(0, 1e12)),
                "the inertia of what pulls it along `direction`")
              .otherwise("0")
              .beside("direction"),
          field(&S::axis, "axis", vector(Dimension::number),
                "of a pinned beam with torsion: its section turns about this direction alone, as a hinge's"),
          field_by<S>("rotation", rotation_fields().shape(),
                      "turns all that a clamped, fork or pinned support holds about an axis in space",
                      [](const Json& json, const std::string& path, S& to, Findings& findings) {
                        to.rotation.emplace().path = path;
                        rotation_fields().read(json, path, *to.rotation, findings);
                      }),
          slope_field(&S::slope),
          field(&S::name, "name", name(), "heads the columns of its reaction"),
          field(
              &S::motion, "motion", vector_table(Dimension::length, plausible(-1e9, 1e9)),
              "moves the support from its reference position: rows [time, dx, dy, dz]; smooth between them, with a continuous "
              "speed and acceleration, at rest at the first and the last; in statics linear"),
          choice_field(&S::motion_join, "interpolation",
                       {{"smooth", RowJoin::smooth_at_rest}, {"linear", RowJoin::linear}},
                       "between the rows of `motion`; linear: the speed jumps at each row")
              .otherwise("smooth")
              .beside("motion"),
          field(&S::motion_law, "motion_law", integer(from(0)), motion_law_help),
      },
      {{{"beam", "body"}, required}}};
  fields.rows.back().in_files = false;
  return fields;
}

}  // namespace nurbeam
