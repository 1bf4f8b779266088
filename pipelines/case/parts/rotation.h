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

inline Fields<CaseRotation> rotation_fields() {
  using namespace shapes;
  using R = CaseRotation;
  return {
      {
          field(&R::axis, "axis", vector(Dimension::number), "direction of the axis, by the right hand")
              .needed(),
          field(
              &R::about, "about", point(),
              "a point of the axis, about which the support goes round too; the supported position when omitted"),
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

}  // namespace nurbeam
