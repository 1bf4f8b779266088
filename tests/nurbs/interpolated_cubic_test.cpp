#include "nurbs/interpolated_cubic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace nurbeam {
namespace {

Eigen::Vector3d helix(double t) { return {std::cos(t), std::sin(t), 0.3 * t}; }

double error_with(int intervals) {
  std::vector<double> t;
  Eigen::Matrix3Xd points(3, intervals + 1);
  for (int i = 0; i <= intervals; ++i) {
    t.push_back(4.0 * i / intervals + 0.3 * std::sin(2.0 * i / intervals));  // uneven
    points.col(i) = helix(t.back());
  }
  const NurbsCurve curve = interpolated_cubic(t, points);
  double largest = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double u = t.back() * i / 1000;
    largest = std::max(largest, (curve.point(u) - helix(u)).norm());
  }
  return largest;
}

TEST(InterpolatedCubic, GoesThroughItsPointsWithContinuousSecondDerivatives) {
  const std::vector<double> t = {0, 1, 1.5, 4, 4.2};
  Eigen::Matrix3Xd points(3, 5);
  points << 0, 1, 3, 2, 1, 0, 2, 1, 1, 0, 1, 1, 0, 2, 2;
  const NurbsCurve curve = interpolated_cubic(t, points);
  for (int i = 0; i < 5; ++i) EXPECT_LT((curve.point(t[i]) - points.col(i)).norm(), 1e-13);
  for (int i = 1; i < 4; ++i)
    EXPECT_LT((curve.derivatives(t[i] - 1e-9, 2) - curve.derivatives(t[i] + 1e-9, 2)).norm(), 1e-5);
}

TEST(InterpolatedCubic, GivesBackACubic) {
  const auto cubic = [](double u) { return Eigen::Vector3d(u * u * u - u, 2 - u * u, 3 * u); };
  std::vector<double> t = {-1, 0, 0.3, 2, 2.5, 3};
  Eigen::Matrix3Xd points(3, 6);
  for (int i = 0; i < 6; ++i) points.col(i) = cubic(t[i]);
  const NurbsCurve curve = interpolated_cubic(t, points);
  for (double u = -1; u <= 3; u += 0.1) EXPECT_LT((curve.point(u) - cubic(u)).norm(), 1e-12);
}

TEST(InterpolatedCubic, IsOfFourthOrder) {
  const double order = std::log2(error_with(20) / error_with(40));
  EXPECT_GT(order, 3.7);
  EXPECT_LT(error_with(40), 1e-4);
}

TEST(InterpolatedCubic, OfTwoOrThreePointsIsALineOrAParabola) {
  const NurbsCurve line = interpolated_cubic({0, 2}, Eigen::Matrix<double, 3, 2>{{0, 2}, {0, 4}, {1, 1}});
  EXPECT_LT((line.point(0.5) - Eigen::Vector3d(0.5, 1, 1)).norm(), 1e-14);
  const NurbsCurve parabola =
      interpolated_cubic({0, 1, 3}, Eigen::Matrix<double, 3, 3>{{0, 1, 3}, {0, 1, 9}, {0, 0, 0}});
  EXPECT_LT((parabola.point(2) - Eigen::Vector3d(2, 4, 0)).norm(), 1e-13);
}

TEST(InterpolatedCubic, RefusesParametersThatDoNotIncrease) {
  EXPECT_THROW(interpolated_cubic({0, 0}, Eigen::Matrix3Xd::Zero(3, 2)), std::invalid_argument);
  EXPECT_THROW(interpolated_cubic({0}, Eigen::Matrix3Xd::Zero(3, 1)), std::invalid_argument);
  EXPECT_THROW(interpolated_cubic({0, 1, 2}, Eigen::Matrix3Xd::Zero(3, 2)), std::invalid_argument);
}

Eigen::Vector3d second_derivative(const NurbsCurve& curve, double u) {
  return curve.derivatives(u, 2).col(2);
}

TEST(InterpolatedCubic, EndsWithTheSlopesThatAreGivenOrStraight) {
  const std::vector<double> t = {0, 1, 2.5, 3, 5};
  Eigen::Matrix3Xd points(3, 5);
  points << 0, 1, 3, 2, 1, 0, 2, 1, 1, 0, 1, 1, 0, 2, 2;
  const Eigen::Vector3d slope(0.3, -2, 1);
  const NurbsCurve curve = interpolated_cubic(t, points, {.start = slope, .end = {}});
  for (int i = 0; i < 5; ++i) EXPECT_LT((curve.point(t[i]) - points.col(i)).norm(), 1e-13);
  EXPECT_LT((curve.derivatives(0, 1).col(1) - slope).norm(), 1e-13);
  EXPECT_LT(second_derivative(curve, 5).norm(), 1e-12);
  const NurbsCurve other = interpolated_cubic(t, points, {.start = {}, .end = slope});
  EXPECT_LT(second_derivative(other, 0).norm(), 1e-12);
  EXPECT_LT((other.derivatives(5, 1).col(1) - slope).norm(), 1e-13);
}

TEST(InterpolatedCubic, StraightAtBothEndsItIsTheSplineOfLeastCurvature) {
  // Through 0, 1, 0: 1.5 t - 0.5 t^3 and its mirror image.
  const NurbsCurve curve =
      interpolated_cubic({0, 1, 2}, Eigen::Matrix<double, 3, 3>{{0, 1, 2}, {0, 1, 0}, {0, 0, 0}}, {});
  for (double u = 0; u <= 1; u += 0.1) {
    EXPECT_NEAR(curve.point(u).y(), 1.5 * u - 0.5 * u * u * u, 1e-15);
    EXPECT_NEAR(curve.point(2 - u).y(), 1.5 * u - 0.5 * u * u * u, 1e-15);
  }
}

TEST(InterpolatedCubic, ClosedItIsSmoothWhereItsEndsMeet) {
  for (const int count : {3, 4, 7, 40}) {
    std::vector<double> t;
    Eigen::Matrix3Xd points(3, count + 1);
    for (int i = 0; i <= count; ++i) {
      t.push_back(i + 0.3 * std::sin(i));
      points.col(i) =
          Eigen::Vector3d(std::cos(7.0 * (i % count)), std::sin(3.0 * (i % count)), (i % count) % 3);
    }
    const NurbsCurve curve = closed_interpolated_cubic(t, points);
    const Eigen::Matrix3Xd start = curve.derivatives(t.front(), 2), end = curve.derivatives(t.back(), 2);
    EXPECT_LT((start - end).norm(), 1e-11 * start.norm()) << count;
    for (int i = 0; i <= count; ++i) EXPECT_LT((curve.point(t[i]) - points.col(i)).norm(), 1e-13) << count;
    for (int i = 1; i < count; ++i)
      EXPECT_LT((second_derivative(curve, t[i] - 1e-10) - second_derivative(curve, t[i])).norm(), 1e-6);
  }
  EXPECT_THROW(closed_interpolated_cubic({0, 1, 2}, Eigen::Matrix3Xd::Zero(3, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
