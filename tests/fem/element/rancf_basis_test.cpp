#include "fem/element/rancf_basis.h"

#include <gtest/gtest.h>

#include <random>

namespace nurbeam {
namespace {

RationalCubic random_rational_cubic(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-3, 3), log_weight(-1.5, 1.5);
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) {
    const double w = std::exp(log_weight(random));
    points.col(i) << w * coordinate(random), w * coordinate(random), w * coordinate(random), w;
  }
  return RationalCubic(points);
}

TEST(RancfBasis, ToBezierIsTheInverseOfToRancf) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> log_length(-3, 3);
  for (int i = 0; i < 5000; ++i) {
    const RationalCubic cubic = random_rational_cubic(random);
    const double l = std::exp(log_length(random));
    const Eigen::Vector4d weights = cubic.points().row(3);
    const RationalCubic back = to_bezier(to_rancf(cubic, l), weights, l);
    EXPECT_LT((back.points() - cubic.points()).norm(), 1e-13 * cubic.points().norm()) << i;
  }
}

TEST(RancfBasis, TheCoordinatesOfACurveAreItsEndsAndTheirDerivatives) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const RationalCubic cubic = random_rational_cubic(random);
    const double l = 0.7, h = 1e-6;
    const NodalCoordinates nodes = to_rancf(cubic, l);
    EXPECT_LT((nodes.col(0) - cubic.point(0)).norm(), 1e-14);
    EXPECT_LT((nodes.col(2) - cubic.point(1)).norm(), 1e-14);
    const Eigen::Vector3d start =
        (-3 * cubic.point(0) + 4 * cubic.point(h) - cubic.point(2 * h)) / (2 * h * l);
    const Eigen::Vector3d end =
        (3 * cubic.point(1) - 4 * cubic.point(1 - h) + cubic.point(1 - 2 * h)) / (2 * h * l);
    EXPECT_LT((nodes.col(1) - start).norm(), 1e-6 * (1 + start.norm()));
    EXPECT_LT((nodes.col(3) - end).norm(), 1e-6 * (1 + end.norm()));
  }
}

}  // namespace
}  // namespace nurbeam
