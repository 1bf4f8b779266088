#pragma once
#include <utility>
#include <vector>

namespace nurbeam {

/// A force over a stretch by rows, joined by a C1 cubic that grows where the rows do, and straight beyond
/// them. The stretch has no unit, or is in metres.
class ForceRows {
 public:
  /// (stretch, force [N]). Throws std::invalid_argument unless there are at least two rows, and both numbers
  /// increase.
  explicit ForceRows(std::vector<std::pair<double, double>> rows);

  struct Point {
    double energy, force, stiffness;  ///< int F de from 0 on, F and dF/de
  };
  Point at(double stretch) const;
  /// The stretch under a force [N].
  double stretch(double force) const;
  const std::vector<std::pair<double, double>>& rows() const { return rows_; }
  bool operator==(const ForceRows& other) const { return rows_ == other.rows_; }

 private:
  Point from_start(double e) const;

  std::vector<std::pair<double, double>> rows_;
  std::vector<double> slopes_, energies_;  ///< at the rows; energies counted from the first row
  double energy_at_zero_ = 0;
};

}  // namespace nurbeam
