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

}  // namespace
}  // namespace nurbeam
