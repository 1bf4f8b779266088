#include "fem/material/section_stresses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nurbeam {
namespace {

TEST(SectionStresses, OfARoundSectionAreThoseOfTheOutermostFibreInAnyDirection) {
  const double r = 0.02, A = std::numbers::pi * r * r, I = A * r * r / 4, N = 900, M = 40, T = 25;
  const SectionStresses stresses = SectionStresses::round(A, I, 2 * I, r);
  for (const double angle : {0.0, 0.7, 2.0, 4.0}) {
    const auto [normal, von_mises] = stresses.largest({-N, M * std::cos(angle), M * std::sin(angle), T});
    const double sigma = N / A + M * r / I, tau = T * r / (2 * I);
    EXPECT_NEAR(normal, -sigma, 1e-12 * sigma);
    EXPECT_NEAR(von_mises, std::sqrt(sigma * sigma + 3 * tau * tau), 1e-12 * sigma);
  }
}

// A rectangle under a load at an angle: N/A + M1 h/(2 I_x) + M2 b/(2 I_y) at one corner.
TEST(SectionStresses, OfARectangleAreLargestAtTheCornerThatBothMomentsStretch) {
  const double b = 0.03, h = 0.05, A = b * h, I_x = b * h * h * h / 12, I_y = h * b * b * b / 12;
  const std::vector<StressPlace> corners = {
      {{b / 2, h / 2}, 0}, {{-b / 2, h / 2}, 0}, {{-b / 2, -h / 2}, 0}, {{b / 2, -h / 2}, 0}};
  const SectionStresses stresses(A, {I_x, I_y}, 0, corners);
  const double expected = 300 / A + 70 * h / 2 / I_x + 20 * b / 2 / I_y;
  EXPECT_NEAR(stresses.largest({300, 70, -20, 0}).normal, expected, 1e-12 * expected);
  EXPECT_NEAR(stresses.largest({-300, -70, 20, 0}).normal, -expected, 1e-12 * expected);
}

// Turned axes: the same rectangle drawn at an angle, loaded by the same moment in space.
TEST(SectionStresses, DoNotDependOnTheAxesThatTheProfileIsDrawnIn) {
  const double b = 0.03, h = 0.05, A = b * h, I_x = b * h * h * h / 12, I_y = h * b * b * b / 12, angle = 0.4;
  const Eigen::Matrix2d R{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
  const Eigen::Matrix2d spread = R * Eigen::Vector2d(I_y, I_x).asDiagonal() * R.transpose();  // int r r^T dA
  std::vector<StressPlace> corners, turned;
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    corners.push_back({{x * b / 2, y * h / 2}, 100});
    turned.push_back({R * corners.back().place, 100});
  }
  const Eigen::Vector2d M(70, 45), turned_M = R * M;
  const auto straight = SectionStresses(A, {I_x, I_y}, 0, corners).largest({10, M[0], M[1], 30});
  const auto skew = SectionStresses(A, {spread(1, 1), spread(0, 0)}, spread(0, 1), turned)
                        .largest({10, turned_M[0], turned_M[1], 30});
  EXPECT_NEAR(straight.normal, skew.normal, 1e-11 * straight.normal);
  EXPECT_NEAR(straight.von_mises, skew.von_mises, 1e-11 * straight.von_mises);
}

TEST(SectionStresses, AreHalfKnownWhereTheShearIsNot) {
  const auto [normal, von_mises] =
      SectionStresses(1, {1, 1}, 0, {{{0, 1}, NAN}, {{1, 0}, NAN}}).largest({1, 2, 3, 4});
  EXPECT_EQ(normal, 3);
  EXPECT_TRUE(std::isnan(von_mises));
}

TEST(SectionStresses, NeedAPlace) { EXPECT_THROW(SectionStresses(1, {1, 1}, 0, {}), std::invalid_argument); }

}  // namespace
}  // namespace nurbeam
