#include "nurbs/smooth/drawn_conic.h"

#include <algorithm>
#include <cmath>

#include "nurbs/smooth/lowest_pieces.h"
#include "nurbs/smooth/rejoin.h"
#include "nurbs/smooth/whole_conic.h"

namespace nurbeam {

namespace smooth {

namespace {

/// The pieces on intervals in which those of one arc have the same derivative where they meet.
Pieces in_even_parameter(Pieces pieces) {
  for (std::size_t j = 0; j + 1 < pieces.size(); ++j) {
    const Points& before = pieces[j].points;
    Points& after = pieces[j + 1].points;
    after *= before(3, 2) / after(3, 0);
    const Eigen::Vector4d leg = before.col(2) - before.col(1);
    const double ratio = leg.dot(after.col(1) - after.col(0)) / leg.squaredNorm();
    pieces[j + 1].length = ratio > 0 ? ratio * pieces[j].length : pieces[j].length;
  }
  return pieces;
}

/// The pieces that end where one of the arcs does, as their lengths along the curve.
std::vector<double> breaks_of(const Pieces& pieces, const Pieces& arcs, double start) {
  std::vector<double> breaks{start};
  double at = start;
  for (const Piece& piece : pieces) {
    at += piece.length;
    const Eigen::Vector3d end = piece.points.col(2).hnormalized();
    const Eigen::Vector3d wanted = arcs[breaks.size() - 1].points.col(2).hnormalized();
    if ((end - wanted).norm() <= 1e-9 * piece.length && breaks.size() < arcs.size()) breaks.push_back(at);
  }
  breaks.push_back(at);
  return breaks;
}

bool is_whole_conic(const Pieces& pieces, double tolerance) {
  const Eigen::Vector3d start = pieces.front().points.col(0).hnormalized(),
                        end = pieces.back().points.col(2).hnormalized();
  if (!((start - end).norm() <= tolerance)) return false;
  const Pieces fewest = rejoined(pieces, 2, CurveParameter::free, widest_spread, 0.5 * tolerance);
  return whole_conic(fewest, 0, 1, tolerance).has_value();
}

NurbsCurve joined(const Pieces& arcs, const std::vector<double>& breaks) {
  std::vector<double> knots(3, breaks.front());
  Points points(4, 2 * static_cast<Eigen::Index>(arcs.size()) + 1);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const auto column = 2 * static_cast<Eigen::Index>(i);
    const double scale = i == 0 ? 1 / arcs[0].weight(0) : points(3, column) / arcs[i].weight(0);
    points.middleCols(column, 3) = scale * arcs[i].points;
    knots.insert(knots.end(), i + 1 == arcs.size() ? 3 : 2, breaks[i + 1]);
  }
  points.rightCols(1) = points(3, points.cols() - 1) / points(3, 0) * points.leftCols(1);  // closed
  return {KnotVector(2, std::move(knots)), std::move(points)};
}

double largest_deviation(const Pieces& pieces) {
  double deviation = 0;
  for (const Piece& piece : pieces) deviation = std::max(deviation, piece.deviation);
  return deviation;
}

}  // namespace

}  // namespace smooth

std::optional<SmoothNurbs> drawn_conic(const BezierPath& path, double tolerance) {
  using namespace smooth;
  if (path.segments.empty()) return std::nullopt;
  const Pieces pieces = lowest_pieces(path, 0.25 * tolerance);
  const double start = path.breaks.front();
  if (pieces.front().degree() != 2 || !is_whole_conic(pieces, tolerance)) return std::nullopt;
  constexpr std::size_t most_arcs = 4;
  const double any_spread = std::log(1e6);
  const Pieces arcs =
      rejoined(in_even_parameter(pieces), 2, CurveParameter::material, any_spread, 0.5 * tolerance);
  if (arcs.size() > most_arcs) return std::nullopt;
  const std::vector<double> breaks = breaks_of(pieces, arcs, start);
  if (breaks.size() != arcs.size() + 1) return std::nullopt;
  return SmoothNurbs{moved_from_start(joined(arcs, breaks), path), largest_deviation(arcs)};
}

}  // namespace nurbeam
