#pragma once
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace nurbeam {

/// The curve that joins rows.
enum class RowJoin {
  smooth,          ///< a cubic spline, C2 and exact for quadratics
  smooth_at_rest,  ///< a cubic spline with slopes 0 at the first and the last row
  linear           ///< straight lines
};

/// A function y(x) through rows, constant outside them.
///
/// Where neighbouring rows of a spline rise or fall together, no piece turns back, and between two equal rows
/// y stays as it is. Slopes that would make a piece overshoot are fixed at the nearest slope that does not
/// (de Boor and Swartz, J. Approx. Theory 21, 1977). There y is C1; the other slopes are C2 up to these rows.
/// Rows of one parabola are joined by it, whatever it does.
class RowCurve {
 public:
  using Row = std::pair<double, double>;  ///< (x, y), x increasing

  /// `bounds`: pieces that would leave them do not turn back either.
  /// Throws std::invalid_argument without rows, or where x does not increase.
  explicit RowCurve(std::vector<Row> rows, RowJoin join = RowJoin::smooth,
                    std::pair<double, double> bounds = unbounded);
  static constexpr std::pair<double, double> unbounded = {-std::numeric_limits<double>::infinity(),
                                                          std::numeric_limits<double>::infinity()};

  struct Point {
    double value, slope, second;  ///< y, dy/dx and d2y/dx2 after x
  };
  Point at(double x) const;
  const std::vector<Row>& rows() const { return rows_; }
  RowJoin join() const { return join_; }
  /// Slopes before and after x, if a row is there.
  std::optional<std::pair<double, double>> slopes_at(double x) const;
  /// Whether the slope or the second derivative jumps at a row.
  bool bends_at(std::size_t row) const { return bends_[row]; }

  /// Largest magnitude of dy/dx.
  double steepest() const;
  /// Least and largest y.
  double least() const;
  double largest() const;

 private:
  // y_0 + u (a + u (b + u c)) for u = (x - x_0)/l from 0 to 1.
  struct Piece {
    double start, length, y, a, b, c;
    Point at(double x) const;
    std::pair<double, double> range() const;
  };
  Piece piece(std::size_t i) const;
  std::pair<double, double> extremes() const;
  void find_slopes(std::pair<double, double> bounds);

  std::vector<Row> rows_;
  RowJoin join_;
  std::vector<double> slopes_;  // at the rows, of a spline
  std::vector<bool> bends_;
};

}  // namespace nurbeam
