#include "nurbs/bezier.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "nurbs/bernstein.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

BezierPoints random_bezier(Generator& generator, int degree) {
  BezierPoints points(4, degree + 1);
  for (int i = 0; i <= degree; ++i) {
    const double weight = uniform(generator, 0.5, 2);
    points.col(i) << weight * random_point(generator), weight;
  }
  return points;
}

/// By the Bernstein polynomials themselves.
Eigen::Vector4d value(const BezierPoints& points, double u) {
  const Eigen::Index p = points.cols() - 1;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  double binomial = 1;
  for (Eigen::Index i = 0; i <= p; ++i) {
    sum += binomial * std::pow(u, double(i)) * std::pow(1 - u, double(p - i)) * points.col(i);
    binomial *= double(p - i) / double(i + 1);
  }
  return sum;
}

double sampled_distance(const BezierPoints& a, const BezierPoints& b) {
  double largest = 0;
  for (int i = 0; i <= 1000; ++i)
    largest =
        std::max(largest, (value(a, 0.001 * i).hnormalized() - value(b, 0.001 * i).hnormalized()).norm());
  return largest;
}

TEST(Bezier, PartsHalvesAndHigherDegreesAreTheSameCurve) {
  Generator generator(90);
  for (int i = 0; i < 200; ++i) {
    const BezierPoints points = random_bezier(generator, 1 + i % 9);
    const double a = uniform(generator, -0.2, 0.5), b = uniform(generator, 0.6, 1.2);
    const auto [left, right] = halves(points);
    for (const double u : {0.0, 0.3, 1.0}) {
      EXPECT_LE((value(part(points, a, b), u) - value(points, a + u * (b - a))).norm(), 1e-12);
      EXPECT_LE((value(left, u) - value(points, 0.5 * u)).norm(), 1e-14);
      EXPECT_LE((value(right, u) - value(points, 0.5 + 0.5 * u)).norm(), 1e-14);
      EXPECT_LE((value(elevated(points, 11), u) - value(points, u)).norm(), 1e-14);
    }
  }
}

TEST(Bezier, TheBlossomIsSymmetricAndGivesTheControlPoints) {
  Generator generator(91);
  const BezierPoints points = random_bezier(generator, 3);
  EXPECT_LE(
      (blossom(points, std::array{0.2, 0.7, -0.4}) - blossom(points, std::array{-0.4, 0.2, 0.7})).norm(),
      1e-15);
  EXPECT_LE((blossom(points, std::array{0.2, 0.2, 0.2}) - value(points, 0.2)).norm(), 1e-15);
  EXPECT_EQ(blossom(points, std::array{0.0, 1.0, 1.0}), points.col(2));
}

TEST(Bezier, TheDistanceBoundIsNeverBelowTheDistanceAndClosesInOnIt) {
  Generator generator(92);
  for (int i = 0; i < 300; ++i) {
    const BezierPoints a = random_bezier(generator, 2 + i % 5);
    BezierPoints b = a;
    for (int k = 1; k < b.cols(); ++k) b.col(k) += uniform(generator, 0, 1e-3) * Eigen::Vector4d::Random();
    const double distance = sampled_distance(a, b);
    EXPECT_GE(distance_bound(a, b) * (1 + 1e-9), distance);
    EXPECT_GE(distance_bound(a, b, 3) * (1 + 1e-9), distance);
    EXPECT_LE(distance_bound(a, b, 3), distance_bound(a, b) * (1 + 1e-9));
    EXPECT_LE(distance_bound(a, 5 * a), 1e-14);  // a factor is no distance
  }
  // u^2 (1-u)^2 has the largest value 1/16; its Bernstein coefficient in degree 4 is 1/6.
  BezierPoints flat = BezierPoints::Zero(4, 5), bump = flat;
  flat.row(3).setOnes();
  bump.row(3).setOnes();
  bump(1, 2) = 1.0 / 6;
  EXPECT_NEAR(distance_bound(flat, bump), 1.0 / 6, 1e-15);
  EXPECT_NEAR(distance_bound(flat, bump, 4), 1.0 / 16, 1e-3);
}

TEST(Bezier, ACurveWithAWeightThatIsNotPositiveIsAtNoDistance) {
  Generator generator(93);
  const BezierPoints a = random_bezier(generator, 3);
  BezierPoints b = a;
  b(3, 2) = 0;
  EXPECT_EQ(distance_bound(a, b), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace nurbeam
