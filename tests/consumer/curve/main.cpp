#include <cmath>
#include <cstdio>
#include <numbers>

#include "nurbs/bezier_path.h"

// The length of a quarter circle of radius 2 m, drawn with one rational quadratic, after its exact elevation
// to a cubic.
int main() {
  const double w = std::numbers::sqrt2 / 2;
  Eigen::Matrix4Xd points(4, 3);
  points << 2, 2 * w, 0, 0, 2 * w, 2, 0, 0, 0, 1, w, 1;
  const nurbeam::NurbsCurve quarter(nurbeam::KnotVector(2, {0, 0, 0, 1, 1, 1}), points);
  const nurbeam::BezierPath path = nurbeam::BezierPath::from_nurbs(quarter, 1e-6);
  std::printf("length %.12f m in %zu cubics\n", path.length(), path.segments.size());
  return path.deviation == 0 && std::abs(path.length() - std::numbers::pi) < 1e-12 ? 0 : 1;
}
