#include "nurbs/smooth/level_weights.h"

#include <array>

#include "nurbs/smooth/linear_factors.h"

namespace nurbeam::smooth {

namespace {

/// Both changes c that, with a linear factor, level the weights at both ends.
std::optional<std::array<double, 2>> levelling(const Piece& piece) {
  constexpr double round_off = 1e-12;
  const double d = double(piece.degree()), a = start_ratio(piece), product = a * end_ratio(piece);
  if (product > 1 + round_off) return std::nullopt;
  const double half = 0.5 * (d * (d + 2) + d * d * product);
  const double root = std::sqrt(std::max(half * half - d * d * (d + 1) * (d + 1) * product, 0.0));
  return std::array{(half - root) / (d * (d + 1) * a), (half + root) / (d * (d + 1) * a)};
}

/// The piece with w_i -> c^i w_i, times the linear factor that levels the weight at its start.
Piece levelled(Piece piece, double c) {
  const double d = double(piece.degree()), factor = d + 1 - d * c * start_ratio(piece);
  double power = 1 / piece.weight(0);
  for (Eigen::Index i = 0; i <= piece.degree(); ++i, power *= c) piece.points.col(i) *= power;
  return times_linear(piece, factor);
}

/// The lengths of the first and last leg, as level weights make them the speed of an interval of 1.
std::pair<double, double> speeds(const Piece& piece) {
  const Eigen::Index p = piece.degree();
  return {double(p) * leg(piece, 0).norm(), double(p) * leg(piece, p - 1).norm()};
}

}  // namespace

std::optional<Pieces> with_level_weights(const Pieces& pieces, double tolerance) {
  Pieces result;
  double speed = 1;  // at the end of the piece before
  for (std::size_t j = 0; j < pieces.size(); ++j) {
    const auto changes = levelling(pieces[j]);
    if (!changes) return std::nullopt;
    std::array<Piece, 2> choice{levelled(pieces[j], (*changes)[0]), levelled(pieces[j], (*changes)[1])};
    const bool joins = j > 0 && share_tangent(pieces[j - 1], pieces[j], tolerance);
    std::array<double, 2> ends;
    for (int k = 0; k < 2; ++k) {
      const auto [start, end] = speeds(choice[k]);
      choice[k].length = joins ? start / speed : std::sqrt(start * end);
      ends[k] = end / choice[k].length;
    }
    const int even = std::abs(std::log(ends[0])) <= std::abs(std::log(ends[1])) ? 0 : 1;
    speed = ends[even];
    if (j > 0) choice[even].points *= result.back().weight(result.back().degree()) / choice[even].weight(0);
    result.push_back(std::move(choice[even]));
  }
  return result;
}

}  // namespace nurbeam::smooth
