#include "nurbs/smooth/smooth_corners.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "nurbs/bezier_path.h"
#include "nurbs/closest_point.h"

namespace nurbeam {
namespace {

/// The cubic with its second control point at that place.
RationalCubic with_second_point(const RationalCubic& cubic, const Eigen::Vector3d& point) {
  Eigen::Matrix4d points = cubic.points();
  points.col(1).head<3>() = cubic.weight(1) * point;
  return RationalCubic(points);
}

/// No less than the distance between two cubics of the same weights: the largest between their control
/// points.
double distance_bound(const RationalCubic& a, const RationalCubic& b) {
  double largest = 0;
  for (int i = 0; i < 4; ++i) largest = std::max(largest, (a.control_point(i) - b.control_point(i)).norm());
  return largest;
}

/// The largest distance of the cubics from those that they are made of. It takes long to measure: where the
/// bound is at the round-off of the coordinates, it is taken for the distance.
double deviation(const std::vector<RationalCubic>& smooth, std::span<const RationalCubic> segments) {
  constexpr double round_off = 1e-15;
  double largest = 0;
  for (std::size_t j = 0; j < segments.size(); ++j) {
    const double bound = distance_bound(smooth[j], segments[j]);
    if (bound <= largest) continue;
    const double size = segments[j].control_point(0).norm() + segments[j].control_point(3).norm();
    const bool measured = bound > round_off * size;
    largest = std::max(largest, measured ? hausdorff_distance({&smooth[j], 1}, {&segments[j], 1}) : bound);
  }
  return largest;
}

}  // namespace

SmoothCorners smooth_corners(std::span<const RationalCubic> segments, double angle) {
  SmoothCorners smooth{{segments.begin(), segments.end()}};
  for (const Corner& corner : corners_of(segments, 0)) {
    if (corner.angle > angle) continue;
    RationalCubic& before = smooth.segments[corner.after_segment];
    RationalCubic& after = smooth.segments[corner.after_segment + 1];
    const Eigen::Vector3d in = before.control_point(3) - before.control_point(2);
    const Eigen::Vector3d out = after.control_point(1) - after.control_point(0);
    if (in.norm() == 0 || out.norm() == 0) continue;
    const Eigen::Vector3d along = (in.normalized() + out.normalized()).normalized();
    before = with_second_point(before.reversed(), corner.point - in.norm() * along).reversed();
    after = with_second_point(after, after.control_point(0) + out.norm() * along);
  }
  smooth.deviation = deviation(smooth.segments, segments);
  return smooth;
}

}  // namespace nurbeam
