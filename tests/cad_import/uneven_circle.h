#pragma once
#include <cmath>
#include <numbers>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The circle of this radius about the origin, in the plane z = 0, in three pieces; its weights fall
/// steadily, so that those of its ends, which are one point, are 1 and 0.8^6.
inline NurbsCurve uneven_circle(double radius) {
  constexpr int count = 7;
  constexpr double sixth = std::numbers::pi / 3, ratio = 0.8;
  Eigen::Matrix4Xd points(4, count);
  for (int i = 0; i < count; ++i) {
    const double cosine = i % 2 == 0 ? 1 : std::cos(sixth);
    const double weight = cosine * std::pow(ratio, i), distance = radius / cosine;
    points.col(i) << weight * distance * std::cos(i * sixth), weight * distance * std::sin(i * sixth), 0,
        weight;
  }
  return NurbsCurve(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 3}), points);
}

}  // namespace nurbeam
