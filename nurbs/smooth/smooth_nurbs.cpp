#include "nurbs/smooth/smooth_nurbs.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "nurbs/smooth/joint_knots.h"
#include "nurbs/smooth/level_weights.h"
#include "nurbs/smooth/linear_factors.h"
#include "nurbs/smooth/lowest_pieces.h"
#include "nurbs/smooth/rejoin.h"
#include "nurbs/smooth/straight_links.h"
#include "nurbs/smooth/whole_conic.h"

namespace nurbeam {

namespace smooth {

namespace {

double total_length(const Pieces& pieces) {
  return std::accumulate(
      pieces.begin(), pieces.end(), 0.0, [](double all, const Piece& piece) { return all + piece.length; });
}

/// The pieces of lowest degree rejoined and written with this degree.
Pieces of_degree(const Pieces& lowest, Eigen::Index degree, CurveParameter parameter, double widest,
                 double tolerance) {
  Pieces pieces = rejoined(lowest, degree, parameter, widest, 0.5 * tolerance);
  for (Piece& piece : pieces)
    if (piece.degree() < degree) piece.points = elevated(balanced(piece.points), degree);
  return pieces;
}

/// The pieces on intervals that are as long together as this.
Pieces scaled(Pieces pieces, double length) {
  const double scale = length / total_length(pieces);
  for (Piece& piece : pieces) piece.length *= scale;
  return pieces;
}

/// How pieces are made to join smoothly.
enum class Way { by_lines, by_runs, by_factors, by_level_weights };

/// The pieces of lowest degree made to join that way, if they can be; written with this degree.
std::optional<Pieces> smoothed(const Pieces& lowest, Way way, Eigen::Index degree, double tolerance) {
  const double quarter_turn = std::log(1.5);  // with what a conic of that needs to spare
  if (way == Way::by_factors)
    return with_linear_factors(of_degree(lowest, degree - 1, CurveParameter::free, widest_spread, tolerance),
                               tolerance);
  if (way == Way::by_level_weights)
    return with_level_weights(of_degree(lowest, degree - 1, CurveParameter::free, quarter_turn, tolerance),
                              tolerance);
  const Pieces pieces = of_degree(lowest, degree, CurveParameter::free, widest_spread, tolerance);
  if (way == Way::by_lines) return with_straight_links(pieces, tolerance);
  return changed(pieces, 0, free_changes(pieces, tolerance));
}

bool is_closed(const Pieces& pieces, double tolerance) {
  const Points &front = pieces.front().points, &back = pieces.back().points;
  return (front.col(0).hnormalized() - back.col(back.cols() - 1).hnormalized()).norm() <= tolerance;
}

/// The number of joints at which the tangents differ.
int corners(const Pieces& pieces, double tolerance) {
  int count = 0;
  for (std::size_t j = 0; j + 1 < pieces.size(); ++j)
    if (!share_tangent(pieces[j], pieces[j + 1], tolerance)) ++count;
  return count;
}

/// The number of interior knots where the curve is only C0 in homogeneous coordinates.
int full_knots(const NurbsCurve& curve) {
  const std::vector<double> breaks = curve.knots().breaks();
  return static_cast<int>(std::count_if(breaks.begin() + 1, breaks.end() - 1, [&](double u) {
    return curve.knots().multiplicity(u) >= curve.degree();
  }));
}

/// A whole conic by itself; else the curve of the first way, in the order of the control points they need,
/// that leaves full knots at corners only; else that with the fewest.
SmoothNurbs smoothest(const Pieces& lowest, double start, double tolerance) {
  if (lowest[0].degree() == 2 && is_closed(lowest, tolerance))
    if (auto conic = whole_conic(of_degree(lowest, 2, CurveParameter::free, widest_spread, tolerance), start,
                                 total_length(lowest), tolerance))
      return std::move(*conic);
  const Eigen::Index p = lowest[0].degree();
  std::vector<std::pair<Way, Eigen::Index>> ways{{Way::by_lines, p}, {Way::by_runs, p}};
  if (p == 2) ways.insert(ways.end(), {{Way::by_lines, 3}, {Way::by_runs, 3}});
  if (p > 1) ways.insert(ways.end(), {{Way::by_factors, p + 1}, {Way::by_level_weights, p + 1}});
  const int needed = corners(lowest, tolerance);
  std::optional<SmoothNurbs> best;
  for (const auto& [way, degree] : ways) {
    const std::optional<Pieces> pieces = smoothed(lowest, way, degree, tolerance);
    if (!pieces) continue;
    SmoothNurbs curve = with_fewest_knots(scaled(*pieces, total_length(lowest)), start, tolerance);
    const bool better = !best || full_knots(curve.curve) < full_knots(best->curve);
    if (better) best = std::move(curve);
    if (full_knots(best->curve) <= needed) break;
  }
  return std::move(*best);
}

SmoothNurbs in_own_parameter(const Pieces& lowest, double start, double tolerance) {
  constexpr CurveParameter own = CurveParameter::material;
  const Pieces pieces = of_degree(lowest, lowest[0].degree(), own, widest_spread, tolerance);
  const auto changes = changes_of_run(pieces, 0, int(pieces.size()) - 1, {1, pieces[0].length}, own);
  return with_fewest_knots(changed(pieces, 0, *changes), start, tolerance);
}

}  // namespace

}  // namespace smooth

SmoothNurbs smooth_nurbs(const BezierPath& path, CurveParameter parameter, double tolerance) {
  using namespace smooth;
  if (path.segments.empty())
    throw std::invalid_argument("a path without segments is no curve; give at least one segment");
  const Pieces lowest = lowest_pieces(path, 0.25 * tolerance);
  SmoothNurbs result = parameter == CurveParameter::free
                           ? smoothest(lowest, path.breaks.front(), tolerance)
                           : in_own_parameter(lowest, path.breaks.front(), tolerance);
  result.curve = moved_from_start(result.curve, path);
  return result;
}

}  // namespace nurbeam
