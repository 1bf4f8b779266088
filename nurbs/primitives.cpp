#include "nurbs/primitives.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace nurbeam {

RationalCubic line_cubic(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) points.col(i) << a + (b - a) * (i / 3.0), 1;
  return RationalCubic(points);
}

std::vector<RationalCubic> arc_cubics(const Eigen::Vector3d& center, const Eigen::Vector3d& start,
                                      const Eigen::Vector3d& end, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d n = normal.normalized(), a = start - center, b = end - center;
  double angle = std::atan2(n.dot(a.cross(b)), a.dot(b));
  if (angle <= 1e-12) angle += 2 * std::numbers::pi;
  const int pieces = static_cast<int>(std::ceil(angle / (std::numbers::pi / 2) - 1e-9));
  const double step = angle / pieces, w1 = (1 + 2 * std::cos(step / 2)) / 3;
  const auto at = [&](double theta) -> Eigen::Vector3d {
    return a * std::cos(theta) + n.cross(a) * std::sin(theta);
  };
  std::vector<RationalCubic> cubics;
  for (int i = 0; i < pieces; ++i) {
    const double theta = i * step;
    const Eigen::Vector3d p0 = at(theta), p3 = i + 1 == pieces ? Eigen::Vector3d(b) : at(theta + step);
    // Control points of the elevated quadratic: w1 P1 = (P0 + 2 w C)/3 with the tangents' intersection C.
    const Eigen::Vector3d tip = at(theta + step / 2) / std::cos(step / 2);
    const double wc = std::cos(step / 2);
    Eigen::Matrix4d points;
    points.col(0) << p0 + center, 1;
    points.col(1) << (p0 + 2 * wc * tip) / 3 + w1 * center, w1;
    points.col(2) << (p3 + 2 * wc * tip) / 3 + w1 * center, w1;
    points.col(3) << p3 + center, 1;
    cubics.emplace_back(points);
  }
  return cubics;
}

std::vector<RationalCubic> arc_cubics(const Eigen::Vector3d& center, double radius, double start, double end,
                                      int pieces) {
  const double step = (end - start) / pieces, w = (1 + 2 * std::cos(step / 2)) / 3;
  const auto radial = [](double angle) { return Eigen::Vector3d(std::cos(angle), std::sin(angle), 0); };
  const auto across = [](double angle) { return Eigen::Vector3d(-std::sin(angle), std::cos(angle), 0); };
  std::vector<RationalCubic> cubics;
  for (int i = 0; i < pieces; ++i) {
    const double a = start + i * step, b = a + step, handle = radius * 2 * std::sin(step / 2) / (3 * w);
    Eigen::Matrix4d points;
    points.col(0) << center + radius * radial(a), 1;
    points.col(1) << w * (center + radius * radial(a) + handle * across(a)), w;
    points.col(2) << w * (center + radius * radial(b) - handle * across(b)), w;
    points.col(3) << center + radius * radial(b), 1;
    cubics.push_back(RationalCubic(points));
  }
  return cubics;
}

}  // namespace nurbeam
