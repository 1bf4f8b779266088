#pragma once
#include <numbers>

#include "nurbs/row_curve.h"
#include "pipelines/case/fields.h"

namespace nurbeam {

/// A prescribed rotation about an axis, at a constant speed or by rows.
struct CaseRotation {
  std::string path;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> about =
      {};                            ///< a point of the axis [m]; the supported position when omitted
  std::optional<double> speed = {};  ///< [rad/s]
  double ramp = 0;                   ///< time in which the speed is reached, from rest [s]
  TimeTable table = {};              ///< [rad]; empty: none
  RowJoin join = RowJoin::smooth_at_rest;
};

/// What drives a hinge of a rigid body, about its axis: one of both.
struct CaseDrive {
  std::string path;
  std::optional<CaseRotation> motion = {};
  TimeTable moment = {};  ///< on the body, as much on what it is joined to [N m]; empty: none
};

/// An angle over time, without its axis.
inline Fields<CaseRotation> angle_fields() {
  using namespace shapes;
  using R = CaseRotation;
  return {
      {
          field_by<R>(
              "table", table(Dimension::angle, plausible(-1e9, 1e9)),
              "angle over time since the drawing: rows [time, angle]; smooth between them, with a "
              "continuous speed and acceleration, at rest at the first and the last; in statics linear",
              [](const Json& json, const std::string&, R& to, Findings&) {
                take(json, to.table);
                for (auto& [time, angle] : to.table) angle *= std::numbers::pi / 180;
              }),
          choice_field(&R::join, "interpolation",
                       {{"smooth", RowJoin::smooth_at_rest}, {"linear", RowJoin::linear}},
                       "between the rows of `table`; linear: the speed jumps at each row")
              .otherwise("smooth")
              .beside("table"),
          field(&R::speed, "speed", quantity(Dimension::angular_speed, plausible(-1e9, 1e9)),
                "constant speed, of a motion"),
          field(&R::ramp, "ramp", quantity(Dimension::time, plausible(0, 1e9)),
                "time in which the speed grows from rest, as t/ramp - sin(2 pi t/ramp)/(2 pi); the speed is "
                "there at once when omitted")
              .beside("speed"),
      },
      {{{"table", "speed"}, required}}};
}

inline Fields<CaseRotation> rotation_fields() {
  using namespace shapes;
  using R = CaseRotation;
  Fields<R> fields = angle_fields();
  fields.rows.insert(
      fields.rows.begin(),
      {field(&R::axis, "axis", vector(Dimension::number), "direction of the axis, by the right hand")
           .needed(),
       field(
           &R::about, "about", point(),
           "a point of the axis, about which the support goes round too; the supported position when omitted")});
  return fields;
}

inline Fields<CaseDrive> drive_fields() {
  using namespace shapes;
  using D = CaseDrive;
  return {{
              field_by<D>("motion", angle_fields().shape(),
                          "prescribes the angle by which the body is turned against what it is joined to",
                          [](const Json& json, const std::string& path, D& drive, Findings& findings) {
                            drive.motion.emplace().path = path;
                            angle_fields().read(json, path, *drive.motion, findings);
                          }),
              field(&D::moment, "moment", constant_or_table(Dimension::moment, plausible(-1e12, 1e12)),
                    "moment about the axis on the body, and as much back on what it is joined to: a number, "
                    "or rows [time, moment]"),
          },
          {{{"motion", "moment"}, required}}};
}

}  // namespace nurbeam
