#include "nurbs/hermite_approximation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>

#include "nurbs/bezier.h"

namespace nurbeam {
namespace {

constexpr double joint_angle = 1e-4;  // a kink above is meant as a corner [rad]
constexpr double never = std::numeric_limits<double>::infinity();

/// A curve as Bezier pieces on the intervals between its breaks.
struct Source {
  std::vector<double> breaks;
  std::vector<BezierPoints> pieces;

  /// The piece that begins at u or holds it.
  std::size_t piece_at(double u) const {
    const auto after = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, u);
    return after - breaks.begin() - 1;
  }
  /// The part of piece j on [a, b], which lies within it.
  BezierPoints part_of(std::size_t j, double a, double b) const {
    const double from = breaks[j], length = breaks[j + 1] - from;
    if (a == from && b == breaks[j + 1]) return pieces[j];
    return part(pieces[j], (a - from) / length, b == breaks[j + 1] ? 1 : (b - from) / length);
  }
};

/// The cubic with the homogeneous end values and end derivatives of the source on [a, b], and a proven bound
/// on its distance from it [m].
struct Approximation {
  Eigen::Matrix4d points;
  double deviation;
};

Approximation hermite(const Source& source, double a, double b) {
  constexpr int halvings = 3;
  const std::size_t first = source.piece_at(a);
  std::size_t last = first;
  while (source.breaks[last + 1] < b) ++last;
  std::vector<BezierPoints> parts;
  std::vector<double> shares{0};  // where the parts end in [a, b], as shares of it
  for (std::size_t j = first; j <= last; ++j) {
    const double end = std::min(b, source.breaks[j + 1]);
    parts.push_back(source.part_of(j, std::max(a, source.breaks[j]), end));
    shares.push_back(j == last ? 1 : (end - a) / (b - a));
  }
  const Eigen::Index p = parts[0].cols() - 1;
  const BezierPoints &front = parts.front(), &back = parts.back();
  const double third = double(p) / 3;
  Approximation cubic;
  cubic.points << front.col(0), front.col(0) + third / shares[1] * (front.col(1) - front.col(0)),
      back.col(p) - third / (1 - shares[shares.size() - 2]) * (back.col(p) - back.col(p - 1)), back.col(p);
  cubic.deviation = cubic.points.row(3).minCoeff() > 0 ? 0 : never;
  for (std::size_t j = 0; j < parts.size() && cubic.deviation < never; ++j) {
    const BezierPoints ours = elevated(part(cubic.points, shares[j], shares[j + 1]), p);
    cubic.deviation = std::max(cubic.deviation, distance_bound(parts[j], ours, halvings));
  }
  return cubic;
}

/// The end of the longest interval from a, no farther than `end`, on which one cubic is within the tolerance.
double longest_interval(const Source& source, double a, double end, double tolerance) {
  constexpr int steps = 30;
  if (hermite(source, a, end).deviation <= tolerance) return end;
  double good = 0, bad = 1;  // shares of [a, end]
  for (int i = 0; i < steps && (good == 0 || bad - good > 1e-3 * good); ++i) {
    const double middle = good == 0 ? 0.5 * bad : 0.5 * (good + bad);
    (hermite(source, a, a + middle * (end - a)).deviation <= tolerance ? good : bad) = middle;
  }
  return a + (good > 0 ? good : bad) * (end - a);
}

/// The breaks of the cubics from `start` to `end`, each as long as the tolerance [m] allows; as soon as there
/// are more than `most` of them the rest is left out.
std::vector<double> greedy_breaks(const Source& source, double start, double end, double tolerance,
                                  std::size_t most) {
  std::vector<double> breaks{start};
  while (breaks.back() < end && breaks.size() <= most + 1)
    breaks.push_back(longest_interval(source, breaks.back(), end, tolerance));
  return breaks;
}

/// The breaks of the fewest cubics within the tolerance, as even in their deviation as that number allows.
std::vector<double> fewest_breaks(const Source& source, double start, double end, double tolerance) {
  std::vector<double> best = greedy_breaks(source, start, end, tolerance, std::size_t(1) << 30);
  double low = 0.05 * tolerance, high = tolerance;
  for (int i = 0; best.size() > 2 && i < 6; ++i) {
    const double middle = 0.5 * (low + high);
    std::vector<double> breaks = greedy_breaks(source, start, end, middle, best.size() - 1);
    const bool enough = breaks.size() <= best.size() && breaks.back() == end;
    (enough ? high : low) = middle;
    if (enough) best = std::move(breaks);
  }
  return best;
}

/// The cubic with its second control point turned, about the first, into this direction.
RationalCubic starting_along(const RationalCubic& cubic, const Eigen::Vector3d& direction) {
  Eigen::Matrix4d points = cubic.points();
  const double leg = (cubic.control_point(1) - cubic.control_point(0)).norm();
  points.col(1).head<3>() = points(3, 1) * (cubic.control_point(0) + leg * direction);
  return RationalCubic(points);
}

/// Turns both tangents of two parts that meet without a corner midway, if that moves neither by more than the
/// bound [m].
void share_tangent(CubicPart& before, CubicPart& after, double bound) {
  const RationalCubic back = before.cubic.reversed();
  const Eigen::Vector3d in = back.control_point(0) - back.control_point(1);
  const Eigen::Vector3d out = after.cubic.control_point(1) - after.cubic.control_point(0);
  const Eigen::Vector3d along = (in.normalized() + out.normalized()).normalized();
  const bool smooth = in.dot(out) > 0 && in.cross(out).norm() < joint_angle * in.norm() * out.norm();
  if (!smooth) return;
  const RationalCubic end = starting_along(back, -along).reversed();
  const RationalCubic start = starting_along(after.cubic, along);
  const double end_moved = distance_bound(before.cubic.points(), end.points());
  const double start_moved = distance_bound(after.cubic.points(), start.points());
  if (!(std::max(end_moved, start_moved) <= bound)) return;
  before = {end, before.start, before.end, before.deviation + end_moved};
  after = {start, after.start, after.end, after.deviation + start_moved};
}

}  // namespace

std::vector<CubicPart> hermite_approximation(const NurbsCurve& curve, double tolerance) {
  Source source{curve.knots().breaks(), {}};
  std::vector<double> ends;
  for (std::size_t j = 0; j + 1 < source.breaks.size(); ++j) {
    source.pieces.push_back(curve.bezier_points(curve.knots().find_span(source.breaks[j])));
    const double end = source.breaks[j + 1];
    if (end == curve.knots().end() || curve.knots().multiplicity(end) >= curve.degree()) ends.push_back(end);
  }
  const double for_tangents = ends.size() > 1 ? 0.1 : 0;  // share of the tolerance
  std::vector<CubicPart> parts;
  double start = source.breaks.front();
  for (const double end : ends) {
    const std::vector<double> breaks = fewest_breaks(source, start, end, (1 - for_tangents) * tolerance);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const Approximation approximation = hermite(source, breaks[i], breaks[i + 1]);
      parts.push_back(
          {RationalCubic(approximation.points), breaks[i], breaks[i + 1], approximation.deviation});
    }
    start = end;
  }
  for (std::size_t i = 0; i + 1 < parts.size(); ++i)
    share_tangent(parts[i], parts[i + 1], 0.5 * for_tangents * tolerance);
  return parts;
}

}  // namespace nurbeam
