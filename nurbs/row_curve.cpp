#include "nurbs/row_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

using Rows = std::vector<RowCurve::Row>;
using Slopes = std::vector<std::optional<double>>;

double length(const Rows& rows, std::size_t i) { return rows[i + 1].first - rows[i].first; }
double secant(const Rows& rows, std::size_t i) {
  return (rows[i + 1].second - rows[i].second) / length(rows, i);
}

// Rows of a tridiagonal system for the slopes: before * d[i-1] + own * d[i] + behind * d[i+1] = right.
struct Equation {
  double before = 0, own = 1, behind = 0, right = 0;
};

// The equation of the first or the last slope. One cubic goes over the two pieces there; where there are no
// four rows, or one of fixed slope is near, a parabola goes over the piece at the end.
Equation end_equation(const Rows& rows, const Slopes& fixed, bool first) {
  const std::size_t last = rows.size() - 1, at = first ? 0 : last - 1;
  const std::size_t near = first ? 1 : last - 1, next = first ? 2 : last - 2;
  if (last < 3 || fixed[near] || fixed[next]) {
    const double right = 2 * secant(rows, at);
    return first ? Equation{0, 1, 1, right} : Equation{1, 1, 0, right};
  }
  const std::size_t beside = first ? 1 : last - 2;
  const double a = length(rows, at), b = length(rows, beside);
  const double right = ((3 * a + 2 * b) * b * secant(rows, at) + a * a * secant(rows, beside)) / (a + b);
  return first ? Equation{0, b, a + b, right} : Equation{a + b, b, 0, right};
}

// Slopes with a continuous second derivative at all rows but those of fixed slope.
std::vector<double> smooth_slopes(const Rows& rows, const Slopes& fixed) {
  const std::size_t n = rows.size(), last = n - 1;
  std::vector<Equation> equations(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (fixed[i]) {
      equations[i].right = *fixed[i];
    } else if (i == 0 || i == last) {
      equations[i] = end_equation(rows, fixed, i == 0);
    } else {
      const double a = 1 / length(rows, i - 1), b = 1 / length(rows, i);
      equations[i] = {a, 2 * (a + b), b, 3 * (a * secant(rows, i - 1) + b * secant(rows, i))};
    }
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = equations[i].before / equations[i - 1].own;
    equations[i].own -= factor * equations[i - 1].behind;
    equations[i].right -= factor * equations[i - 1].right;
  }
  std::vector<double> slopes(n);
  for (std::size_t i = n; i-- > 0;)
    slopes[i] =
        (equations[i].right - (i < last ? equations[i].behind * slopes[i + 1] : 0)) / equations[i].own;
  return slopes;
}

// Whether six rows in the middle of which a piece lies are of one parabola, to the digits of a file.
bool is_on_parabola(const Rows& rows, std::size_t piece) {
  constexpr double digits = 1e-6;  // of the second derivative
  if (piece < 2 || piece + 3 >= rows.size()) return false;
  double least = std::numeric_limits<double>::infinity(), largest = -least;
  for (std::size_t i = piece - 2; i <= piece + 1; ++i) {
    const double second = (secant(rows, i + 1) - secant(rows, i)) / (length(rows, i) + length(rows, i + 1));
    least = std::min(least, second);
    largest = std::max(largest, second);
  }
  return largest - least <= digits * std::max(std::abs(least), std::abs(largest));
}

// Whether the rows around a piece rise together, or fall together. Between two equal rows y stays as it is,
// unless a parabola turns there.
bool is_monotone(const Rows& rows, std::size_t piece) {
  if (secant(rows, piece) == 0) return !is_on_parabola(rows, piece);
  const std::size_t first = piece > 0 ? piece - 1 : 0, last = std::min(piece + 1, rows.size() - 2);
  bool rises = false, falls = false;
  for (std::size_t i = first; i <= last; ++i) {
    rises = rises || secant(rows, i) > 0;
    falls = falls || secant(rows, i) < 0;
  }
  return !(rises && falls);
}

// Whether a cubic with slopes of `a` and `b` times the secant at its ends runs one way (Fritsch and Carlson,
// SIAM J. Numer. Anal. 17, 1980).
bool runs_one_way(double a, double b) {
  if (a < 0 || b < 0) return false;
  if (2 * a + b <= 3 || a + 2 * b <= 3) return true;
  return a * (a + b - 2) * 3 >= (2 * a + b - 3) * (2 * a + b - 3);
}

// The slope next to `slope` with which every piece beside a row that must not turn can run one way.
double limited(const Rows& rows, const std::vector<bool>& runs_on, std::size_t row, double slope) {
  for (std::size_t piece = row > 0 ? row - 1 : 0; piece <= row && piece + 1 < rows.size(); ++piece) {
    const double d = secant(rows, piece);
    if (runs_on[piece]) slope = std::clamp(slope, std::min(0.0, 3 * d), std::max(0.0, 3 * d));
  }
  return slope;
}

// Fixes slopes at the ends of pieces that turn back though they must not. Returns whether there were some.
bool fix_slopes(const Rows& rows, const std::vector<double>& slopes, const std::vector<bool>& runs_on,
                Slopes& fixed) {
  bool any = false;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const double d = secant(rows, i);
    const bool one_way =
        d == 0 ? slopes[i] == 0 && slopes[i + 1] == 0 : runs_one_way(slopes[i] / d, slopes[i + 1] / d);
    if (one_way || !runs_on[i]) continue;
    for (const std::size_t row : {i, i + 1}) {
      const double slope = limited(rows, runs_on, row, slopes[row]);
      if (slope == slopes[row]) continue;
      fixed[row] = slope;
      any = true;
    }
  }
  return any;
}

// Whether the rows lie on one parabola, whose slopes these are, to the digits of a file. It takes four rows
// to know, or five where two are equal: four may as well rise, wait and fall.
bool are_of_parabola(const Rows& rows, const std::vector<double>& slopes) {
  constexpr double digits = 1e-9;
  double least = rows[0].second, largest = least, off = 0;
  bool waits = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    least = std::min(least, rows[i].second);
    largest = std::max(largest, rows[i].second);
    waits = waits || (i > 0 && rows[i].second == rows[i - 1].second);
  }
  const double second = (slopes.back() - slopes.front()) / (rows.back().first - rows.front().first);
  for (const auto& [x, y] : rows) {
    const double from = x - rows[0].first;
    off = std::max(off, std::abs(rows[0].second + from * (slopes[0] + from / 2 * second) - y));
  }
  return rows.size() > (waits ? 4 : 3) && off <= digits * (largest - least);
}

}  // namespace

RowCurve::RowCurve(std::vector<Row> rows, RowJoin join, std::pair<double, double> bounds)
    : rows_(std::move(rows)), join_(join), bends_(rows_.size(), true) {
  if (rows_.empty()) throw std::invalid_argument("a curve through rows has at least one row");
  for (std::size_t i = 0; i + 1 < rows_.size(); ++i)
    if (!(rows_[i].first < rows_[i + 1].first))
      throw std::invalid_argument("the first numbers of rows must increase; " + text_of(rows_[i + 1].first) +
                                  " follows " + text_of(rows_[i].first));
  if (join_ != RowJoin::linear && rows_.size() > 1) find_slopes(bounds);
}

void RowCurve::find_slopes(std::pair<double, double> bounds) {
  const std::size_t last = rows_.size() - 1;
  Slopes fixed(rows_.size());
  if (join_ == RowJoin::smooth_at_rest)
    fixed[0] = fixed[last] = 0;
  else if (last == 1)
    fixed[0] = fixed[1] = secant(rows_, 0);
  slopes_ = smooth_slopes(rows_, fixed);
  const bool parabola = join_ == RowJoin::smooth && are_of_parabola(rows_, slopes_);
  std::vector<bool> runs_on(last, false);
  for (std::size_t i = 0; i < last; ++i) runs_on[i] = !parabola && is_monotone(rows_, i);
  for (bool more = true; more;) {
    for (std::size_t i = 0; i < last; ++i) {
      const auto [low, high] = piece(i).range();
      const auto [a, b] = std::minmax(rows_[i].second, rows_[i + 1].second);
      runs_on[i] = runs_on[i] || low < std::min(bounds.first, a) || high > std::max(bounds.second, b);
    }
    more = fix_slopes(rows_, slopes_, runs_on, fixed);
    if (more) slopes_ = smooth_slopes(rows_, fixed);
  }
  for (std::size_t i = 1; i < last; ++i) bends_[i] = fixed[i].has_value();
}

RowCurve::Piece RowCurve::piece(std::size_t i) const {
  const double l = length(rows_, i), rise = rows_[i + 1].second - rows_[i].second;
  const auto [x, y] = rows_[i];
  if (join_ == RowJoin::linear) return {x, l, y, rise, 0, 0};
  const double a = l * slopes_[i], b = l * slopes_[i + 1];
  return {x, l, y, a, 3 * rise - 2 * a - b, a + b - 2 * rise};
}

RowCurve::Point RowCurve::Piece::at(double x) const {
  const double u = (x - start) / length;
  return {y + u * (a + u * (b + u * c)), (a + u * (2 * b + u * 3 * c)) / length,
          (2 * b + 6 * u * c) / (length * length)};
}

RowCurve::Point RowCurve::at(double x) const {
  if (x < rows_.front().first) return {rows_.front().second, 0, 0};
  if (x >= rows_.back().first) return {rows_.back().second, 0, 0};
  const auto next =
      std::upper_bound(rows_.begin(), rows_.end(), x, [](double a, const Row& row) { return a < row.first; });
  return piece(static_cast<std::size_t>(next - rows_.begin()) - 1).at(x);
}

std::optional<std::pair<double, double>> RowCurve::slopes_at(double x) const {
  const auto found =
      std::lower_bound(rows_.begin(), rows_.end(), x, [](const Row& row, double a) { return row.first < a; });
  if (found == rows_.end() || found->first != x) return {};
  const auto row = static_cast<std::size_t>(found - rows_.begin());
  const bool first = row == 0, last = row + 1 == rows_.size();
  return std::pair(first ? 0 : piece(row - 1).at(x).slope, last ? 0 : piece(row).at(x).slope);
}

double RowCurve::steepest() const {
  double steepest = 0;
  for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
    const Piece of = piece(i);
    const double inside = of.c == 0 ? -1 : -of.b / (3 * of.c);
    for (const double u : {0.0, 1.0, inside})
      if (u >= 0 && u <= 1) steepest = std::max(steepest, std::abs(of.at(of.start + u * of.length).slope));
  }
  return steepest;
}

std::pair<double, double> RowCurve::Piece::range() const {
  std::pair<double, double> range = std::minmax(y, y + a + b + c);
  const double square = b * b - 3 * a * c;
  if (square < 0) return range;
  // Roots of the slope a + 2 b u + 3 c u^2.
  const double half = -(b + std::copysign(std::sqrt(square), b));
  for (const double u : {half / (3 * c), a / half})
    if (u > 0 && u < 1) {
      const double value = y + u * (a + u * (b + u * c));
      range = {std::min(range.first, value), std::max(range.second, value)};
    }
  return range;
}

double RowCurve::least() const { return extremes().first; }
double RowCurve::largest() const { return extremes().second; }

std::pair<double, double> RowCurve::extremes() const {
  std::pair<double, double> extremes = {rows_[0].second, rows_[0].second};
  for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
    const auto [low, high] = piece(i).range();
    extremes = {std::min(extremes.first, low), std::max(extremes.second, high)};
  }
  return extremes;
}

}  // namespace nurbeam
