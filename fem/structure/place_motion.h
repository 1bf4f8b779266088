#pragma once
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "fem/time_table.h"
#include "nurbs/row_curve.h"

namespace nurbeam {

/// A prescribed place on a beam over time: the curve through the rows of a table, or a smooth function.
class PlaceMotion {
 public:
  struct Moment {
    double s, speed, acceleration;  ///< [m], [m/s], [m/s^2]
  };
  using Law = std::function<Moment(double t)>;

  /// Rows (t [s], s [m]). Throws std::invalid_argument without rows, or where times do not increase.
  /// `bounds`: of the beam [m].
  PlaceMotion(TimeTable rows, RowJoin join = RowJoin::smooth,
              std::pair<double, double> bounds = RowCurve::unbounded)
      : rows_(RowCurve(std::move(rows), join, bounds)) {}
  explicit PlaceMotion(Law law) : law_(std::move(law)) {}

  /// The curve through the rows; empty where a function prescribes the place.
  const std::optional<RowCurve>& rows() const { return rows_; }
  Moment at(double t) const {
    if (law_) return law_(t);
    const RowCurve::Point now = rows_->at(t);
    return {now.value, now.slope, now.second};
  }

 private:
  std::optional<RowCurve> rows_;
  Law law_;
};

}  // namespace nurbeam
