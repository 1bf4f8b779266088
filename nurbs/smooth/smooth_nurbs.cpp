#include "nurbs/smooth/smooth_nurbs.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "nurbs/smooth/joint_knots.h"
#include "nurbs/smooth/rejoin.h"

namespace nurbeam {

namespace smooth {

namespace {

/// The curve of degree - 1 nearest to this one (the one it is, if there is one).
Points reduced(const Points& points) {
  if (points.cols() == 3) return (Points(4, 2) << points.col(0), points.col(2)).finished();
  const Eigen::Vector4d middle = 0.25 * (3 * (points.col(1) + points.col(2)) - points.col(0) - points.col(3));
  return (Points(4, 3) << points.col(0), middle, points.col(3)).finished();
}

/// The pieces written with the lowest degree that they all have.
Pieces of_lowest_degree(Pieces pieces, double tolerance) {
  while (pieces.front().degree() > 1) {
    Pieces lower = pieces;
    for (Piece& piece : lower) {
      const Points points = reduced(piece.points);
      piece.deviation += distance_bound(piece.points, elevated(points, piece.degree()));
      if (!(piece.deviation <= tolerance)) return pieces;
      piece.points = points;
    }
    pieces = std::move(lower);
  }
  return pieces;
}

/// The curve of the pieces, written with this degree, that begins at the parameter `start`.
SmoothNurbs joined(Pieces pieces, Eigen::Index degree, double start, CurveParameter parameter,
                   double tolerance) {
  const auto sum = [](double all, const auto& part) { return all + part.length; };
  const double length = std::accumulate(pieces.begin(), pieces.end(), 0.0, sum);
  pieces = rejoined(pieces, degree, parameter, 0.5 * tolerance);
  for (Piece& piece : pieces)
    if (piece.degree() < degree) piece.points = elevated(balanced(piece.points), degree);
  if (parameter == CurveParameter::free) {
    std::vector<MoebiusChange> charts = free_changes(pieces, tolerance);
    const double scale = length / std::accumulate(charts.begin(), charts.end(), 0.0, sum);
    for (MoebiusChange& chart : charts) chart.length *= scale;
    pieces = changed(pieces, 0, charts);
  } else {
    pieces = changed(pieces, 0,
                     *changes_of_run(pieces, 0, int(pieces.size()) - 1, {1, pieces[0].length}, parameter));
  }
  return with_fewest_knots(pieces, start, tolerance);
}

/// The number of interior knots where the curve is only C0 in homogeneous coordinates.
int full_knots(const NurbsCurve& curve) {
  const std::vector<double> breaks = curve.knots().breaks();
  return static_cast<int>(std::count_if(breaks.begin() + 1, breaks.end() - 1, [&](double u) {
    return curve.knots().multiplicity(u) >= curve.degree();
  }));
}

NurbsCurve shifted(const NurbsCurve& curve, const Eigen::Vector3d& by) {
  Points points = curve.control_points();
  points.topRows<3>() += by * curve.control_points().row(3);
  return {curve.knots(), std::move(points)};
}

}  // namespace

}  // namespace smooth

SmoothNurbs smooth_nurbs(const BezierPath& path, CurveParameter parameter, double tolerance) {
  using namespace smooth;
  if (path.segments.empty())
    throw std::invalid_argument("a path without segments is no curve; give at least one segment");
  // Measured from the start, so that a curve far from the origin keeps its digits.
  const Eigen::Vector3d origin = path.segments.front().control_point(0);
  Pieces pieces;
  for (std::size_t j = 0; j < path.segments.size(); ++j) {
    Points points = path.segments[j].points() / path.segments[j].weight(0);
    points.topRows<3>() -= (origin * points.row(3)).eval();
    pieces.push_back({std::move(points), path.breaks[j + 1] - path.breaks[j]});
  }
  const Pieces lowest = of_lowest_degree(std::move(pieces), 0.25 * tolerance);
  const double start = path.breaks.front();
  SmoothNurbs result = joined(lowest, lowest[0].degree(), start, parameter, tolerance);
  // A whole circle of degree 2 is not C1 throughout; of degree 3 it can be, with no more control points.
  if (parameter == CurveParameter::free && lowest[0].degree() == 2 && full_knots(result.curve) > 0) {
    SmoothNurbs cubic = joined(lowest, 3, start, parameter, tolerance);
    if (full_knots(cubic.curve) < full_knots(result.curve) &&
        cubic.curve.control_points().cols() <= result.curve.control_points().cols())
      result = std::move(cubic);
  }
  result.curve = shifted(result.curve, origin);
  return result;
}

}  // namespace nurbeam
