#include "nurbs/rational_cubic.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <stdexcept>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

/// A quarter of the unit circle: the degree-elevated rational quadratic.
RationalCubic quarter_circle() {
  const double h = std::sqrt(0.5);
  Eigen::Matrix<double, 4, 3> quadratic;
  quadratic << 1, h, 0, 0, h, 1, 0, 0, 0, 1, h, 1;
  Eigen::Matrix4d points;
  points << quadratic.col(0), (quadratic.col(0) + 2 * quadratic.col(1)) / 3,
      (2 * quadratic.col(1) + quadratic.col(2)) / 3, quadratic.col(2);
  return RationalCubic(points);
}

TEST(RationalCubicTest, AQuarterCircleHasUnitRadiusAndCurvature) {
  const RationalCubic arc = quarter_circle();
  for (int i = 0; i <= 1000; ++i) {
    const Eigen::Matrix<double, 3, 6> r = arc.derivatives(1e-3 * i);
    const Eigen::Vector3d first = r.col(1), second = r.col(2);
    EXPECT_NEAR(arc.point(1e-3 * i).norm(), 1, 1e-15);
    EXPECT_NEAR(r.col(0).norm(), 1, 1e-15);
    EXPECT_NEAR(first.cross(second).norm() / std::pow(first.norm(), 3), 1, 3e-15);
  }
}

TEST(RationalCubicTest, TheDerivativesAreThoseOfATaylorSeriesOfOrderSix) {
  Generator generator(2);
  for (int i = 0; i < 1000; ++i) {
    const RationalCubic cubic = random_cubic(generator);
    const double u = uniform(generator, 0.1, 0.9);
    const Eigen::Matrix<double, 3, 6> r = cubic.derivatives(u);
    const auto remainder = [&](double h) {
      Eigen::Vector3d sum = cubic.point(u + h);
      double factor = 1;
      for (int k = 0; k <= 5; ++k) {
        sum -= factor * r.col(k);
        factor *= h / (k + 1);
      }
      return sum;
    };
    const double h = 2e-3;
    ASSERT_LE((remainder(2 * h) - 64 * remainder(h)).norm(), 0.2 * (64 * remainder(h)).norm() + 3e-14);
  }
}

TEST(RationalCubicTest, TheWeightIsItsOwnTaylorPolynomial) {
  Generator generator(3);
  for (int i = 0; i < 1000; ++i) {
    const RationalCubic cubic = random_cubic(generator);
    const double u = uniform(generator, 0, 1), h = uniform(generator, -1, 1);
    const auto [w, w1, w2, w3] = cubic.weighted_derivatives(u).weight;
    ASSERT_NEAR(cubic.weighted_derivatives(u + h).weight[0], w + h * w1 + h * h / 2 * w2 + h * h * h / 6 * w3,
                1e-13);
  }
}

TEST(RationalCubicTest, DerivativesWithTheWeightAreTheOnesWithout) {
  Generator generator(13);
  for (int i = 0; i < 1000; ++i) {
    const RationalCubic cubic = random_cubic(generator);
    const double u = uniform(generator, 0, 1);
    const Eigen::Matrix<double, 3, 6> r = cubic.derivatives(u);
    const RationalCubic::WeightedDerivatives same = cubic.weighted_derivatives(u);
    for (int k = 1; k <= 4; ++k)
      ASSERT_LE((same.r[static_cast<std::size_t>(k - 1)] - r.col(k)).norm(), 1e-12 * r.rightCols<5>().norm());
  }
}

TEST(RationalCubicTest, TheHodographOverTheSquaredWeightIsTheFirstDerivative) {
  Generator generator(4);
  for (int i = 0; i < 1000; ++i) {
    const RationalCubic cubic = random_cubic(generator);
    const double u = uniform(generator, 0, 1), v = 1 - u, w = cubic.weighted_derivatives(u).weight[0];
    Eigen::Matrix<double, 5, 1> bernstein;
    bernstein << v * v * v * v, 4 * u * v * v * v, 6 * u * u * v * v, 4 * u * u * u * v, u * u * u * u;
    const Eigen::Vector3d slope = cubic.derivatives(u).col(1);
    ASSERT_LE((cubic.hodograph() * bernstein / (w * w) - slope).norm(), 1e-13);
  }
}

TEST(RationalCubicTest, EqualControlPointsGiveThatPointWhateverTheWeights) {
  Generator generator(5);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d place = random_point(generator);
    Eigen::Matrix4d points = random_cubic(generator).points();
    points.topRows<3>() = place * points.row(3);
    ASSERT_LE((RationalCubic(points).point(uniform(generator, 0, 1)) - place).norm(), 1e-15);
  }
}

TEST(RationalCubicTest, TheHalvesOfASplitLieOnTheWholeAndShareTheirEnd) {
  Generator generator(6);
  for (int i = 0; i < 1000; ++i) {
    const RationalCubic whole = random_cubic(generator);
    const double cut = uniform(generator, 0.01, 0.99), t = uniform(generator, 0, 1);
    const auto [left, right] = whole.split(cut);
    ASSERT_EQ(left.points().col(3), right.points().col(0));
    ASSERT_EQ(left.points().col(0), whole.points().col(0));
    ASSERT_EQ(right.points().col(3), whole.points().col(3));
    ASSERT_LE((left.point(t) - whole.point(cut * t)).norm(), 3e-15);
    ASSERT_LE((right.point(t) - whole.point(cut + (1 - cut) * t)).norm(), 3e-15);
  }
}

TEST(RationalCubicTest, APieceOfAPieceIsThePieceOfTheWhole) {
  Generator generator(7);
  for (int i = 0; i < 1000; ++i) {
    const RationalCubic whole = random_cubic(generator);
    const double a = uniform(generator, 0, 0.4), b = uniform(generator, 0.5, 1);
    const double c = uniform(generator, 0, 0.4), d = uniform(generator, 0.5, 1);
    const RationalCubic twice = whole.piece(a, b).piece(c, d);
    const RationalCubic once = whole.piece(a + (b - a) * c, a + (b - a) * d);
    ASSERT_LE((twice.points() - once.points()).norm(), 1e-14);
  }
}

TEST(RationalCubicTest, TheReversedRunsBackwards) {
  Generator generator(8);
  for (int i = 0; i < 1000; ++i) {
    const RationalCubic cubic = random_cubic(generator);
    const double u = uniform(generator, 0, 1);
    ASSERT_LE((cubic.reversed().point(u) - cubic.point(1 - u)).norm(), 2e-15);
    ASSERT_EQ(cubic.reversed().reversed().points(), cubic.points());
  }
}

TEST(RationalCubicTest, TheCurvatureOfAnArcAKilometreAwayKeepsItsDigits) {
  Eigen::Matrix4d points = quarter_circle().points();
  points.row(0) += 1024 * points.row(3);
  const Eigen::Matrix<double, 3, 6> r = RationalCubic(points).derivatives(0.3);
  const Eigen::Vector3d first = r.col(1), second = r.col(2);
  EXPECT_NEAR(first.cross(second).norm() / std::pow(first.norm(), 3), 1, 1e-11);
  // Equal weights and binary coordinates move without any error at all.
  Eigen::Matrix4d plain;
  plain << 0, 0.5, 1, 0.25, 0, 1, 0.75, 0.5, 0, 0, 0.5, 1, 1, 1, 1, 1;
  Eigen::Matrix4d far = plain;
  far.topRows<3>().array() += 1024;
  EXPECT_EQ(RationalCubic(plain).derivatives(0.3).rightCols<5>(),
            RationalCubic(far).derivatives(0.3).rightCols<5>());
}

TEST(RationalCubicTest, NonPositiveWeightsAndValuesThatAreNotFiniteAreRefused) {
  Eigen::Matrix4d points = quarter_circle().points();
  points(3, 2) = 0;
  EXPECT_THROW(RationalCubic{points}, std::invalid_argument);
  points(3, 2) = -1;
  EXPECT_THROW(RationalCubic{points}, std::invalid_argument);
  points(3, 2) = 1;
  points(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(RationalCubic{points}, std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
