#include "nurbs/regular_segments.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "nurbs/arc_length.h"
#include "nurbs/closest_point.h"

namespace nurbeam {
double polygon_length(const RationalCubic& cubic) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += (cubic.control_point(i + 1) - cubic.control_point(i)).norm();
  return sum;
}

namespace {

/// Whether the speed at the start is zero, but for round-off.
bool stands_still(const RationalCubic& cubic) {
  constexpr double round_off = 1e-9;
  return (cubic.control_point(1) - cubic.control_point(0)).norm() <= round_off * polygon_length(cubic);
}

/// The direction in which the cubic starts, from its first control point that is another one.
Eigen::Vector3d leaving_direction(const RationalCubic& cubic) {
  const Eigen::Vector3d leg = cubic.control_point(2) - cubic.control_point(0);
  const bool leads = leg.norm() > 1e-9 * polygon_length(cubic);
  return (leads ? leg : Eigen::Vector3d(cubic.control_point(3) - cubic.control_point(0))).normalized();
}

/// The polynomial cubic with the ends and end directions of this one and even legs.
RationalCubic evened(const RationalCubic& cubic) {
  const RationalCubic back = cubic.reversed();
  const double third = length(cubic) / 3;
  Eigen::Matrix4d points = Eigen::Matrix4d::Ones();
  points.col(0).head<3>() = cubic.control_point(0);
  points.col(1).head<3>() = cubic.control_point(0) + third * leaving_direction(cubic);
  const Eigen::Vector3d in =
      stands_still(back) ? leaving_direction(back)
                         : Eigen::Vector3d(back.control_point(1) - back.control_point(0)).normalized();
  points.col(2).head<3>() = cubic.control_point(3) + third * in;
  points.col(3).head<3>() = cubic.control_point(3);
  return RationalCubic(points);
}

/// Cubics that start with a speed in place of one that does not: an evened one, as long as the tolerance
/// allows, and the rest.
std::vector<RationalCubic> set_going(const RationalCubic& cubic, double tolerance, double& deviation) {
  constexpr int most_halvings = 40;
  double share = 1;
  for (int i = 0; i < most_halvings; ++i, share *= 0.5) {
    const std::array<RationalCubic, 1> piece{share < 1 ? cubic.piece(0, share) : cubic},
        even{evened(piece[0])};
    const double distance = hausdorff_distance(piece, even);
    if (distance > tolerance) continue;
    deviation = std::max(deviation, distance);
    if (share == 1) return {even[0]};
    return {even[0], cubic.piece(share, 1)};
  }
  return {cubic};
}

std::vector<RationalCubic> reversed(std::vector<RationalCubic> segments) {
  std::reverse(segments.begin(), segments.end());
  for (RationalCubic& segment : segments) segment = segment.reversed();
  return segments;
}

RationalCubic ending_at(const RationalCubic& cubic, const Eigen::Vector3d& point) {
  Eigen::Matrix4d points = cubic.points();
  points.col(3).head<3>() = points(3, 3) * point;
  return RationalCubic(points);
}

void drop_slivers(std::span<const RationalCubic> given, double sliver, RegularSegments& result) {
  double run = 0;  // of slivers one after another, which together may be long [m]
  for (const RationalCubic& cubic : given) {
    if (polygon_length(cubic) > sliver) {
      run = 0;
      result.segments.push_back(cubic);
      continue;
    }
    ++result.dropped;
    run += polygon_length(cubic);
    result.deviation = std::max(result.deviation, run);
    if (!result.segments.empty())
      result.segments.back() = ending_at(result.segments.back(), cubic.control_point(3));
  }
}

}  // namespace

RegularSegments regular_segments(std::span<const RationalCubic> segments, double sliver, double tolerance) {
  RegularSegments result;
  drop_slivers(segments, sliver, result);
  std::vector<RationalCubic> regular;
  for (const RationalCubic& cubic : result.segments) {
    const bool at_start = stands_still(cubic), at_end = stands_still(cubic.reversed());
    if (!at_start && !at_end) {
      regular.push_back(cubic);
      continue;
    }
    std::vector<RationalCubic> pieces{cubic};
    if (at_start) pieces = set_going(cubic, tolerance, result.deviation);
    if (stands_still(pieces.back().reversed())) {
      const std::vector<RationalCubic> tail =
          reversed(set_going(pieces.back().reversed(), tolerance, result.deviation));
      pieces.pop_back();
      pieces.insert(pieces.end(), tail.begin(), tail.end());
    }
    ++result.replaced;
    regular.insert(regular.end(), pieces.begin(), pieces.end());
  }
  result.segments = std::move(regular);
  return result;
}

}  // namespace nurbeam
