#include "nurbs/area_moments.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

/// The unit circle scaled along x and y and moved.
std::vector<RationalCubic> ellipse(double a, double b, double x, double y) {
  Eigen::Matrix4Xd points = unit_circle().control_points();
  points.row(0) = a * points.row(0) + x * points.row(3);
  points.row(1) = b * points.row(1) + y * points.row(3);
  return BezierPath::from_nurbs(NurbsCurve(unit_circle().knots(), points), 0).segments;
}

TEST(AreaMoments, OfAnEllipseAreItsClosedForms) {
  const double a = 3, b = 0.5, x = 0.7, y = -0.2, area = pi * a * b;
  const AreaMoments m = area_moments(ellipse(a, b, x, y));
  EXPECT_NEAR(m.area, area, 1e-14 * area);
  EXPECT_NEAR(m.first(0), area * x, 1e-14 * area);
  EXPECT_NEAR(m.first(1), area * y, 1e-14 * area);
  EXPECT_NEAR(m.second(0, 0), area * (a * a / 4 + x * x), 1e-13);
  EXPECT_NEAR(m.second(1, 1), area * (b * b / 4 + y * y), 1e-14);
  EXPECT_NEAR(m.second(0, 1), area * x * y, 1e-14);
  EXPECT_EQ(m.second(1, 0), m.second(0, 1));
}

TEST(AreaMoments, UnderAParabolaAreThoseOfThePolynomial) {
  // y = x (1 - x) over [0, 1], closed by the x axis; run through unevenly.
  Eigen::Matrix4d arch;
  arch << 1, 2.0 / 3, 1.0 / 3, 0, 0, 1.0 / 3, 1.0 / 3, 0, 0, 0, 0, 0, 1, 1, 1, 1;
  const BezierPath base = BezierPath::from_nurbs(line({0, 0, 0}, {1, 0, 0}), 0);
  const AreaMoments m = area_moments(std::array{base.segments[0], moebius(RationalCubic(arch), 3)});
  EXPECT_NEAR(m.area, 1.0 / 6, 1e-15);
  EXPECT_NEAR(m.first(0), 1.0 / 12, 1e-15);
  EXPECT_NEAR(m.first(1), 1.0 / 60, 1e-15);
  EXPECT_NEAR(m.second(0, 0), 1.0 / 20, 1e-15);
  EXPECT_NEAR(m.second(0, 1), 1.0 / 120, 1e-15);
  EXPECT_NEAR(m.second(1, 1), 1.0 / 420, 1e-15);
}

TEST(AreaMoments, OfAHoleRunThroughClockwiseAreTakenAway) {
  AreaMoments m = area_moments(ellipse(2, 2, 0, 0));
  m += area_moments(BezierPath::from_nurbs(unit_circle().reversed(), 0).segments);
  EXPECT_NEAR(m.area, 3 * pi, 1e-13);
  EXPECT_NEAR(m.second(0, 0), 15 * pi / 4, 1e-13);
  EXPECT_NEAR(m.second(1, 1), 15 * pi / 4, 1e-13);
}

}  // namespace
}  // namespace nurbeam
