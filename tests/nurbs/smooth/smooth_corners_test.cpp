#include "nurbs/smooth/smooth_corners.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "nurbs/closest_point.h"
#include "nurbs/curve_chain.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

// Two legs of 1 m along the x-axis that meet at this angle in the origin.
BezierPath bent(double angle) {
  const NurbsCurve a = line({-1, 0, 0}, {0, 0, 0}),
                   b = line({0, 0, 0}, {std::cos(angle), std::sin(angle), 0});
  return join({a, b}, find_chains({a, b}, 1e-9).front(), 1e-9);
}

TEST(SmoothCorners, TurnBothTangentsMidwayAndKeepTheEnds) {
  const double angle = 0.08;
  const SmoothCorners path = smooth_corners(bent(angle).segments, 0.1);
  EXPECT_TRUE(corners_of(path.segments, 1e-14).empty());
  const Eigen::Vector3d leg = path.segments[1].control_point(1) - path.segments[1].control_point(0);
  EXPECT_NEAR(leg.norm(), 1.0 / 3, 1e-15);
  EXPECT_NEAR(std::atan2(leg.y(), leg.x()), angle / 2, 1e-15);
  EXPECT_EQ(path.segments[0].control_point(0), bent(angle).segments[0].control_point(0));
  EXPECT_EQ(path.segments[0].control_point(3), Eigen::Vector3d::Zero());
  EXPECT_EQ(path.segments[1].control_point(3), bent(angle).segments[1].control_point(3));
}

TEST(SmoothCorners, ReportTheDistanceThatTheCurveMoved) {
  // One leg of 1 m turned by a small angle b at its end: the cubic is off its chord by b/3 · 3 u (1 - u)²,
  // at most 4/27 b at u = 1/3.
  const double angle = 0.02;
  EXPECT_NEAR(smooth_corners(bent(angle).segments, 0.1).deviation, 4.0 / 27 * angle / 2, 1e-4 * angle);
}

TEST(SmoothCorners, LeaveALargerCornerAsItIs) {
  const SmoothCorners path = smooth_corners(bent(0.2).segments, 0.1);
  EXPECT_EQ(path.deviation, 0);
  ASSERT_EQ(corners_of(path.segments, 1e-9).size(), 1U);
  EXPECT_NEAR(corners_of(path.segments, 1e-9)[0].angle, 0.2, 1e-14);
}

TEST(SmoothCorners, KeepWeightsAndWorkOnRationalCubics) {
  Generator generator(12);
  for (int i = 0; i < 50; ++i) {
    const RationalCubic a = random_cubic(generator);
    RationalCubic b = random_cubic(generator);
    Eigen::Matrix4d moved = b.points();
    const Eigen::Vector3d shift = a.control_point(3) - b.control_point(0);
    for (int k = 0; k < 4; ++k) moved.col(k).head<3>() += moved(3, k) * shift;
    b = RationalCubic(moved);
    const SmoothCorners path = smooth_corners(std::array{a, b}, 3.0);
    EXPECT_EQ(path.segments[0].points().row(3), a.points().row(3));
    EXPECT_EQ(path.segments[1].points().row(3), b.points().row(3));
    if (corners_of(std::array{a, b}, 3.0).empty()) EXPECT_TRUE(corners_of(path.segments, 1e-12).empty());
  }
}

}  // namespace
}  // namespace nurbeam
