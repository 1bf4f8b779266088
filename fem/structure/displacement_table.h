#pragma once
#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "nurbs/row_curve.h"

namespace nurbeam {

/// A displacement over time: for each component the curve through its rows. Outside the rows it is at rest.
class DisplacementTable {
 public:
  using Row = std::pair<double, Eigen::Vector3d>;  ///< (t [s], displacement [m]), t increasing

  /// Throws std::invalid_argument where the times do not increase, or there is no row.
  explicit DisplacementTable(const std::vector<Row>& rows, RowJoin join = RowJoin::smooth_at_rest);
  struct Motion {
    Eigen::Vector3d value, rate, acceleration;  ///< [m], [m/s], [m/s^2] after t
  };
  using Law = std::function<Motion(double t)>;
  /// A smooth function instead of rows: components() is then empty.
  explicit DisplacementTable(Law law) : law_(std::move(law)) {}

  /// The curves of the three components, with rows at equal times.
  const std::vector<RowCurve>& components() const { return components_; }
  Motion at(double t) const;

 private:
  std::vector<RowCurve> components_;
  Law law_;
};

}  // namespace nurbeam
