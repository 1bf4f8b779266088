#include "nurbs/smooth/lowest_pieces.h"

namespace nurbeam::smooth {

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

Eigen::Vector3d start_of(const BezierPath& path) { return path.segments.front().control_point(0); }

}  // namespace

Pieces lowest_pieces(const BezierPath& path, double tolerance) {
  const Eigen::Vector3d origin = start_of(path);
  Pieces pieces;
  for (std::size_t j = 0; j < path.segments.size(); ++j) {
    Points points = path.segments[j].points() / path.segments[j].weight(0);
    points.topRows<3>() -= (origin * points.row(3)).eval();
    pieces.push_back({std::move(points), path.breaks[j + 1] - path.breaks[j]});
  }
  return of_lowest_degree(std::move(pieces), tolerance);
}

NurbsCurve moved_from_start(const NurbsCurve& curve, const BezierPath& path) {
  Points points = curve.control_points();
  points.topRows<3>() += start_of(path) * curve.control_points().row(3);
  return {curve.knots(), std::move(points)};
}

}  // namespace nurbeam::smooth
