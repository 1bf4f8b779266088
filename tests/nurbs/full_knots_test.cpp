#include "nurbs/full_knots.h"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

Eigen::Matrix4Xd homogeneous(const Eigen::Matrix3Xd& points, const Eigen::RowVectorXd& weights) {
  Eigen::Matrix4Xd result(4, points.cols());
  result << points * weights.asDiagonal(), weights;
  return result;
}

Eigen::Matrix4Xd with_weights_1(const Eigen::Matrix3Xd& points) {
  return homogeneous(points, Eigen::RowVectorXd::Ones(points.cols()));
}

TEST(SplitAtFullKnots, ASplineWithoutThemIsOneCurveAsItIs) {
  Generator generator(7);
  for (int i = 0; i < 100; ++i) {
    const NurbsCurve curve = random_nurbs(generator, 1 + i % 5, i % 2 == 0, i % 3 > 0);
    const auto curves = split_at_full_knots(curve.degree(), curve.knots().knots(), curve.control_points());
    ASSERT_EQ(curves.size(), 1U);
    EXPECT_EQ(curves[0].knots(), curve.knots());
    EXPECT_EQ(curves[0].control_points(), curve.control_points());
  }
}

TEST(SplitAtFullKnots, BezierCurvesThatMeetAreOneCurve) {
  // Two quarters of the unit circle, the second with other weights.
  const double w = std::numbers::sqrt2 / 2;
  Eigen::Matrix3Xd points(3, 6);
  points << 1, 1, 0, 0, -1, -1, 0, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0;
  const Eigen::RowVectorXd weights{{1, w, 1, 3, 3 * w, 3}};
  const auto curves = split_at_full_knots(2, {0, 0, 0, 1, 1, 1, 2.5, 2.5, 2.5}, homogeneous(points, weights));
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].knots().knots(), (std::vector<double>{0, 0, 0, 1, 1, 2.5, 2.5, 2.5}));
  EXPECT_NEAR(length(curves[0]), std::numbers::pi, 1e-14);
  for (double u = 0; u <= 2.5; u += 0.125) EXPECT_NEAR(curves[0].point(u).norm(), 1, 1e-15);
}

TEST(SplitAtFullKnots, ThoseThatDoNotMeetAreCurvesOfTheirOwn) {
  Eigen::Matrix3Xd points(3, 6);
  points << 0, 1, 5, 6, 7, 9, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0;
  const auto curves = split_at_full_knots(1, {0, 0, 1, 1, 2, 2, 3, 3}, with_weights_1(points));
  ASSERT_EQ(curves.size(), 3U);
  EXPECT_NEAR(length(curves[0]), 1, 1e-15);
  EXPECT_NEAR(length(curves[1]), std::numbers::sqrt2, 1e-15);
  EXPECT_NEAR(length(curves[2]), 2, 1e-15);
  EXPECT_EQ(curves[2].knots().start(), 2);
}

TEST(SplitAtFullKnots, PointsThatNothingDependsOnAreLeftOut) {
  // The knot 1 stands four times, and those at the ends three times, for twice of a degree of 1.
  Eigen::Matrix3Xd points(3, 8);
  points << 77, 0, 1, 88, 99, 1, 3, 66, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0;
  const auto curves = split_at_full_knots(1, {0, 0, 0, 1, 1, 1, 1, 2, 2, 2}, with_weights_1(points));
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].control_points().cols(), 3);
  EXPECT_NEAR(length(curves[0]), 3, 1e-15);
}

TEST(SplitAtFullKnots, WhatIsNoCurveIsRefused) {
  const Eigen::Matrix4Xd points = with_weights_1(Eigen::Matrix3Xd::Random(3, 4));
  EXPECT_THROW(split_at_full_knots(3, {0, 0, 0, 0, 1, 1, 1}, points), std::invalid_argument);
  EXPECT_THROW(split_at_full_knots(3, {0, 0, 0, 0, 1, 1, 1, 0.5}, points), std::invalid_argument);
  EXPECT_THROW(split_at_full_knots(3, {0, 0, 0, 0, 0, 0, 0, 0}, points), std::invalid_argument);
  EXPECT_THROW(split_at_full_knots(0, {0, 0, 0, 0, 1}, points), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
