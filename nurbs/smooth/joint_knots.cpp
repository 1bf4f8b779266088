#include "nurbs/smooth/joint_knots.h"

#include <algorithm>

#include "nurbs/bernstein.h"

namespace nurbeam::smooth {

namespace {

/// Distance in space of two homogeneous points of nearly the same weight, with what their weights differ by.
double mismatch(const Eigen::Vector4d& a, const Eigen::Vector4d& b, double size) {
  return (a.hnormalized() - b.hnormalized()).norm() + size * std::abs(a(3) - b(3)) / std::abs(a(3));
}

/// The largest k < degree for which two pieces in their charts join in C^k, in homogeneous coordinates.
int continuity(const Piece& left, const Piece& right, double tolerance) {
  const Eigen::Index p = left.degree();
  const double size = leg(left, p - 1).norm() + leg(right, 0).norm();
  const double share = left.length / (left.length + right.length);
  // The joint lies on the line between its neighbours.
  const Eigen::Vector4d between = (1 - share) * left.points.col(p - 1) + share * right.points.col(1);
  if (p < 2 || !(mismatch(left.points.col(p), between, size) <= tolerance)) return 0;
  if (p < 3) return 1;
  // f(t_j, t_{j-1}, t_{j+1}) from both sides.
  const Eigen::Vector4d from_left =
      left.points.col(p - 2) + (left.points.col(p - 1) - left.points.col(p - 2)) / share;
  const Eigen::Vector4d from_right =
      right.points.col(2) + (right.points.col(1) - right.points.col(2)) / (1 - share);
  return mismatch(from_left, from_right, size) <= tolerance ? 2 : 1;
}

/// The knots of pieces that begin at `start`, each joint with the multiplicity that its continuity needs.
std::vector<double> knots_of(const Pieces& pieces, const std::vector<int>& orders, double start) {
  const int p = static_cast<int>(pieces[0].degree());
  std::vector<double> knots(p + 1, start);
  for (std::size_t j = 0; j < pieces.size(); ++j) {
    start += pieces[j].length;
    knots.insert(knots.end(), j < orders.size() ? p - orders[j] : p + 1, start);
  }
  return knots;
}

/// The B-spline of the pieces: control point i is f(t_{i+1}, ..., t_{i+p}), the mean of the values from all
/// pieces that lie among these knots.
NurbsCurve assembled(const Pieces& pieces, const std::vector<int>& orders, double start) {
  const int p = static_cast<int>(pieces[0].degree());
  KnotVector knots(p, knots_of(pieces, orders, start));
  const std::vector<double>& t = knots.knots();
  const std::vector<double> breaks = knots.breaks();
  Points points(4, knots.control_point_count());
  for (int i = 0; i < points.cols(); ++i) {
    const double low = t[i + 1], high = t[i + p];
    const auto at = std::lower_bound(breaks.begin(), breaks.end(), low) - breaks.begin();
    int j = std::min<int>(int(at), int(pieces.size()) - 1), count = 0;
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    do {
      std::vector<double> arguments(t.begin() + i + 1, t.begin() + i + p + 1);
      const double a = breaks[j], b = breaks[j + 1];
      for (double& u : arguments) u = u == b ? 1 : (u - a) / (b - a);
      sum += blossom(pieces[j].points, arguments);
      ++count;
      ++j;
    } while (j < int(pieces.size()) && breaks[j] < high);
    points.col(i) = sum / count;
  }
  constexpr double round_off = 1e-13;
  if (spread(points.row(3)) < round_off) {
    for (int i = 0; i < 3; ++i) points.row(i).array() /= points.row(3).array();
    points.row(3).setOnes();
  }
  return {std::move(knots), std::move(points)};
}

/// Bounds on the distances between the pieces and the curve made of them.
std::vector<double> deviations(const NurbsCurve& curve, const Pieces& pieces) {
  const std::vector<double> breaks = curve.knots().breaks();
  std::vector<double> bounds;
  for (std::size_t j = 0; j < pieces.size(); ++j)
    bounds.push_back(
        pieces[j].deviation +
        distance_bound(pieces[j].points, curve.bezier_points(curve.knots().find_span(breaks[j]))));
  return bounds;
}

}  // namespace

SmoothNurbs with_fewest_knots(const Pieces& pieces, double start, double tolerance) {
  std::vector<int> orders;
  for (std::size_t j = 0; j + 1 < pieces.size(); ++j)
    orders.push_back(continuity(pieces[j], pieces[j + 1], tolerance));
  while (true) {
    NurbsCurve curve = assembled(pieces, orders, start);
    const std::vector<double> bounds = deviations(curve, pieces);
    bool lowered = false;
    for (std::size_t j = 0; j < pieces.size(); ++j) {
      if (bounds[j] <= tolerance) continue;
      for (const std::size_t joint : {j - 1, j})
        if (joint < orders.size() && orders[joint] > 0) {
          --orders[joint];
          lowered = true;
        }
    }
    if (!lowered) return {std::move(curve), *std::max_element(bounds.begin(), bounds.end())};
  }
}

}  // namespace nurbeam::smooth
