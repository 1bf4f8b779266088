#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <utility>

#include "fem/time_table.h"
#include "nurbs/row_curve.h"

namespace nurbeam {

/// A prescribed angle over time: the curve through the rows of a table, or a smooth function.
class AngleMotion {
 public:
  struct Moment {
    double angle, rate, acceleration;  ///< [rad], [rad/s], [rad/s^2]
  };
  using Law = std::function<Moment(double t)>;

  /// Rows (t [s], angle [rad]). Throws std::invalid_argument without rows, or where times do not increase.
  explicit AngleMotion(TimeTable rows, RowJoin join = RowJoin::smooth_at_rest)
      : rows_(RowCurve(std::move(rows), join)) {}
  explicit AngleMotion(Law law) : law_(std::move(law)) {}
  /// Turns at a constant speed [rad/s], from the start on. With a `ramp` [s] the speed grows to that from
  /// rest, w(t) = speed (t/ramp - sin(2 pi t/ramp)/(2 pi)), and its rate begins and ends at zero.
  static AngleMotion at_speed(double speed, double ramp = 0);

  /// The curve through the rows; empty where a function prescribes the angle.
  const std::optional<RowCurve>& rows() const { return rows_; }
  Moment at(double t) const {
    if (law_) return law_(t);
    const RowCurve::Point now = rows_->at(t);
    return {now.value, now.slope, now.second};
  }
  /// A bound of the way from one time to a later one [rad].
  double way(double from, double to) const;

 private:
  std::optional<RowCurve> rows_;
  Law law_;
};

/// A prescribed rotation about an axis in space.
struct AxisTurn {
  Eigen::Vector3d axis;   ///< of unit length
  Eigen::Vector3d about;  ///< a point of the axis [m]
  AngleMotion angle;

  /// The rotation by an angle, and its derivatives by the angle: [axis x] R and [axis x]^2 R.
  struct Rotation {
    Eigen::Matrix3d R, first, second;
  };
  Rotation by(double angle) const;
  /// (3 x 3) R, and its first and second derivative by time at fixed `load`, which scales the angle.
  Rotation at(double t, double load) const;
};

}  // namespace nurbeam
