#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace nurbeam {

/// A displacement over time: the C1 cubic through its rows, in each component monotone where they are, so
/// that nothing is overshot and no speed jumps; at rest at the first and the last row and outside.
class DisplacementTable {
 public:
  using Row = std::pair<double, Eigen::Vector3d>;  ///< (t [s], displacement [m]), t increasing

  /// Throws std::invalid_argument where the times do not increase, or there is no row.
  explicit DisplacementTable(std::vector<Row> rows);
  struct Motion {
    Eigen::Vector3d value, rate, acceleration;  ///< [m], [m/s], [m/s^2] after t
  };
  using Law = std::function<Motion(double t)>;
  /// A smooth function in the place of rows, of which there are none.
  explicit DisplacementTable(Law law) : law_(std::move(law)) {}

  const std::vector<Row>& rows() const { return rows_; }
  Motion at(double t) const;

 private:
  std::vector<Row> rows_;
  std::vector<Eigen::Vector3d> slopes_;  // at the rows
  Law law_;
};

}  // namespace nurbeam
