#include "fem/motion/record/sag.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nurbeam {
namespace {

/// The parabola z = 4 f x (x - L) / L^2 + rise x / L in pieces: a cubic each.
std::vector<ElementRecord> parabola(double L, double f, double rise, int pieces) {
  const auto at = [&](double x) {
    return Eigen::Vector3d(x, 2, 4 * f * x * (x - L) / (L * L) + rise * x / L);
  };
  const auto slope = [&](double x) {
    return Eigen::Vector3d(1, 0, 4 * f * (2 * x - L) / (L * L) + rise / L);
  };
  std::vector<ElementRecord> elements(pieces);
  for (int i = 0; i < pieces; ++i) {
    const double x = L * i / pieces, h = L / pieces;
    elements[i].control_points.row(3).setOnes();
    elements[i].control_points.topRows<3>() << at(x), at(x) + h / 3 * slope(x),
        at(x + h) - h / 3 * slope(x + h), at(x + h);
  }
  return elements;
}

const Eigen::Vector3d down(0, 0, -9.81);

TEST(Sag, OfAParabolaIsItsDepthBelowTheChordWhereverItsEndsAre) {
  for (const int pieces : {1, 2, 5, 8})
    for (const double rise : {0.0, -3.0, 7.0})
      EXPECT_NEAR(sag(parabola(10, 0.7, rise, pieces), down), 0.7, 1e-9);
}

TEST(Sag, OfAnArchIsNone) { EXPECT_EQ(sag(parabola(10, -0.7, 1, 4), down), 0); }

TEST(Sag, NeedsGravityAndEndsThatAreApart) {
  EXPECT_TRUE(std::isnan(sag(parabola(10, 0.7, 0, 3), Eigen::Vector3d::Zero())));
  EXPECT_TRUE(std::isnan(sag(parabola(10, 0.7, 0, 3), Eigen::Vector3d(1, 0, 0))));
}

}  // namespace
}  // namespace nurbeam
