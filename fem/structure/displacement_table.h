#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace nurbeam {

/// A displacement over time: a C1 cubic through the rows. Each component is monotone where its rows are, so
/// that nothing is overshot and no speed jumps. At the first and the last row, and outside, it is at rest.
class DisplacementTable {
 public:
  using Row = std::pair<double, Eigen::Vector3d>;  ///< (t [s], displacement [m]), t increasing

  /// Throws std::invalid_argument where the times do not increase, or there is no row.
  explicit DisplacementTable(std::vector<Row> rows);
  struct Motion {
    Eigen::Vector3d value, rate, acceleration;  ///< [m], [m/s], [m/s^2] after t
  };
  using Law = std::function<Motion(double t)>;
  /// A smooth function instead of rows: rows() is then empty.
  explicit DisplacementTable(Law law) : law_(std::move(law)) {}

  const std::vector<Row>& rows() const { return rows_; }
  Motion at(double t) const;

 private:
  std::vector<Row> rows_;
  std::vector<Eigen::Vector3d> slopes_;  // at the rows
  Law law_;
};

}  // namespace nurbeam
