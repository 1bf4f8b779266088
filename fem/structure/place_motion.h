#pragma once
#include <functional>
#include <utility>

#include "fem/time_table.h"

namespace nurbeam {

/// A prescribed place on a beam over time: the rows of a table, with jumps of the speed, or a smooth
/// function.
class PlaceMotion {
 public:
  struct Moment {
    double s, speed, acceleration;  ///< [m], [m/s], [m/s^2]
  };
  using Law = std::function<Moment(double t)>;

  PlaceMotion(TimeTable rows) : rows_(std::move(rows)) {}
  explicit PlaceMotion(Law law) : law_(std::move(law)) {}

  /// Rows (t [s], s [m]), linear between, constant outside; empty where a function prescribes the place.
  const TimeTable& rows() const { return rows_; }
  Moment at(double t) const {
    if (law_) return law_(t);
    const auto [s, speed] = value_and_slope(rows_, t);
    return {s, speed, 0};
  }

 private:
  TimeTable rows_;
  Law law_;
};

}  // namespace nurbeam
