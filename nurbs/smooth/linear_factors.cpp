#include "nurbs/smooth/linear_factors.h"

#include <algorithm>

#include "nurbs/golden_section.h"
#include "nurbs/smooth/rejoin.h"

namespace nurbeam::smooth {

namespace {

/// The pieces, each with the same weight at both ends, on intervals that make the speed continuous, that at
/// the start 1.
Pieces balanced_of_even_speed(Pieces pieces) {
  double speed = 1;
  for (Piece& piece : pieces) {
    piece.points = balanced(piece.points);
    const Eigen::Index p = piece.degree();
    piece.length = double(p) * start_ratio(piece) * leg(piece, 0).norm() / speed;
    speed = double(p) * end_ratio(piece) * leg(piece, p - 1).norm() / piece.length;
  }
  return pieces;
}

/// The pieces times the linear functions that make them C1, if that of the first ends with `factor`; nothing
/// where one would not stay positive.
std::optional<Pieces> multiplied(const Pieces& pieces, double factor) {
  const double d = double(pieces[0].degree());
  Pieces result{times_linear(pieces[0], factor)};
  for (std::size_t j = 1; j < pieces.size(); ++j) {
    const Piece &before = pieces[j - 1], &piece = pieces[j];
    const double slope =
        (d + 1 - d * end_ratio(before) - 1 / factor) / before.length;  // of the weight, at the joint
    factor = d + 1 - d * start_ratio(piece) + slope * piece.length;
    if (!(factor > 0)) return std::nullopt;
    const double scale = result.back().weight(result.back().degree()) / piece.weight(0);
    result.push_back(times_linear(piece, factor));
    result.back().points *= scale;
  }
  return result;
}

double spread_of(const Pieces& pieces) {
  double low = never, high = -never;
  for (const Piece& piece : pieces) {
    low = std::min(low, piece.points.row(3).minCoeff());
    high = std::max(high, piece.points.row(3).maxCoeff());
  }
  return low > 0 ? std::log(high / low) : never;
}

}  // namespace

Piece times_linear(const Piece& piece, double factor) {
  const Eigen::Index d = piece.degree();
  Points points = Points::Zero(4, d + 2);
  for (Eigen::Index i = 0; i <= d; ++i) {
    points.col(i) += double(d + 1 - i) / double(d + 1) * piece.points.col(i);
    points.col(i + 1) += factor * double(i + 1) / double(d + 1) * piece.points.col(i);
  }
  return {std::move(points), piece.length, piece.deviation};
}

std::optional<Pieces> with_linear_factors(const Pieces& pieces, double tolerance) {
  constexpr int steps = 60;
  for (std::size_t j = 0; j + 1 < pieces.size(); ++j)
    if (!share_tangent(pieces[j], pieces[j + 1], tolerance)) return std::nullopt;
  const Pieces even = balanced_of_even_speed(pieces);
  const auto spread_at = [&](double log_factor) {
    const auto result = multiplied(even, std::exp(log_factor));
    return result ? spread_of(*result) : 1e3 - log_factor;  // the factor was too small
  };
  const auto result =
      multiplied(even, std::exp(minimum_place(spread_at, -widest_spread, widest_spread, steps)));
  if (!result || !(spread_of(*result) <= widest_spread)) return std::nullopt;
  return result;
}

}  // namespace nurbeam::smooth
