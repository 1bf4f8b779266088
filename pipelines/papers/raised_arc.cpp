#include "pipelines/papers/raised_arc.h"

#include <cmath>

namespace nurbeam {

Eigen::Vector3d arc_end(double radius, double half_angle) {
  return {radius * std::sin(2 * half_angle), radius * (1 - std::cos(2 * half_angle)), 0};
}

RationalCubic raised_arc(double radius, double half_angle, double c) {
  const double w = c * std::cos(half_angle);
  const Eigen::Vector3d tip(radius * std::tan(half_angle), 0, 0);
  Eigen::Matrix<double, 4, 3> conic;
  conic.col(0) << 0, 0, 0, 1;
  conic.col(1) << w * tip, w;
  conic.col(2) << c * c * arc_end(radius, half_angle), c * c;
  Eigen::Matrix4d points;
  points.col(0) = conic.col(0);
  points.col(1) = (conic.col(0) + 2 * conic.col(1)) / 3;
  points.col(2) = (2 * conic.col(1) + conic.col(2)) / 3;
  points.col(3) = conic.col(2);
  return RationalCubic(points);
}

}  // namespace nurbeam
