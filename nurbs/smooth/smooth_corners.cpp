#include "nurbs/smooth/smooth_corners.h"

#include <algorithm>

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
  for (std::size_t j = 0; j < segments.size(); ++j)
    if (smooth.segments[j].points() != segments[j].points())
      smooth.deviation =
          std::max(smooth.deviation, hausdorff_distance({&smooth.segments[j], 1}, {&segments[j], 1}));
  return smooth;
}

}  // namespace nurbeam
