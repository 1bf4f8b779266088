#include "nurbs/nurbs_curve.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

TEST(NurbsCurveTest, ARationalQuadraticCircleHasUnitRadiusAndCurvature) {
  const NurbsCurve circle = unit_circle();
  for (int i = 0; i <= 1000; ++i) {
    const Eigen::Matrix3Xd r = circle.derivatives(4e-3 * i, 2);
    const Eigen::Vector3d first = r.col(1), second = r.col(2);
    EXPECT_NEAR(r.col(0).norm(), 1, 1e-15);
    EXPECT_NEAR(first.cross(second).norm() / std::pow(first.norm(), 3), 1, 3e-15);
  }
}

TEST(NurbsCurveTest, ThePeriodicCircleIsTheClampedOne) {
  const NurbsCurve clamped = unit_circle(), periodic = unit_circle(-1, 5);
  for (int i = 0; i <= 1000; ++i)
    EXPECT_LE((clamped.point(4e-3 * i) - periodic.point(4e-3 * i)).norm(), 1e-15);
}

TEST(NurbsCurveTest, EqualControlPointsGiveThatPointWhateverTheWeightsAndKnots) {
  Generator generator(10);
  for (int i = 0; i < 2000; ++i) {
    const NurbsCurve random = random_nurbs(generator, 1 + i % 5, true, i % 2 == 0);
    const Eigen::Vector3d place = random_point(generator);
    Eigen::Matrix4Xd points = random.control_points();
    points.topRows<3>() = place * points.row(3);
    const NurbsCurve curve(random.knots(), points);
    const double u = uniform(generator, curve.knots().start(), curve.knots().end());
    ASSERT_LE((curve.point(u) - place).norm(), 1e-15);
  }
}

TEST(NurbsCurveTest, ACurveWhosePointsAreTheGrevilleAbscissaeIsTheParameterItself) {
  Generator generator(11);
  for (int i = 0; i < 2000; ++i) {
    const int p = 1 + i % 5;
    const KnotVector knots = random_knots(generator, p, i % 2 == 0);
    Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, knots.control_point_count());
    for (int j = 0; j < points.cols(); ++j)
      for (int k = 1; k <= p; ++k) points(0, j) += knots.knots()[j + k] / p;
    const NurbsCurve curve = make_nurbs_curve(knots, points, Eigen::VectorXd::Ones(points.cols()));
    const double u = uniform(generator, knots.start(), knots.end());
    const Eigen::Matrix3Xd r = curve.derivatives(u, 2);
    ASSERT_NEAR(r(0, 0), u, 1e-14);
    ASSERT_NEAR(r(0, 1), 1, 1e-13);
    ASSERT_NEAR(r(0, 2), 0, 1e-11);
  }
}

TEST(NurbsCurveTest, TheDerivativesAreThoseOfATaylorSeriesInsideASpan) {
  Generator generator(12);
  for (int i = 0; i < 1000; ++i) {
    const NurbsCurve curve = random_nurbs(generator, 1 + i % 5, true, i % 2 == 0);
    const std::vector<double> breaks = curve.knots().breaks();
    const double width = breaks[1] - breaks[0];
    const double u = breaks[0] + 0.5 * width;
    const Eigen::Matrix3Xd r = curve.derivatives(u, 5);
    const auto remainder = [&](double h) {
      Eigen::Vector3d sum = curve.point(u + h);
      double factor = 1;
      for (int k = 0; k <= 5; ++k) {
        sum -= factor * r.col(k);
        factor *= h / (k + 1);
      }
      return sum;
    };
    const double h = 2e-3 * width;
    ASSERT_LE((remainder(2 * h) - 64 * remainder(h)).norm(), 0.2 * (64 * remainder(h)).norm() + 3e-13);
  }
}

TEST(NurbsCurveTest, TheBezierPointsOfASpanGiveItsPoints) {
  Generator generator(13);
  for (int i = 0; i < 1000; ++i) {
    const NurbsCurve curve = random_nurbs(generator, 3, true, i % 2 == 0);
    const std::vector<double> breaks = curve.knots().breaks();
    const double a = breaks[0], b = breaks[1], t = uniform(generator, 0, 1);
    const RationalCubic piece{Eigen::Matrix4d(curve.bezier_points(curve.knots().find_span(a)))};
    ASSERT_LE((piece.point(t) - curve.point(a + (b - a) * t)).norm(), 1e-14);
  }
}

TEST(NurbsCurveTest, TheReversedRunsBackwardsOverTheSameParameters) {
  Generator generator(14);
  for (int i = 0; i < 1000; ++i) {
    const NurbsCurve curve = random_nurbs(generator, 1 + i % 5, i % 3 == 0, i % 2 == 0);
    const NurbsCurve back = curve.reversed();
    const double a = curve.knots().start(), b = curve.knots().end(), u = uniform(generator, a, b);
    ASSERT_NEAR(back.knots().start(), a, 1e-14);
    ASSERT_NEAR(back.knots().end(), b, 1e-14);
    ASSERT_LE((back.point(a + b - u) - curve.point(u)).norm(), 1e-12);
  }
}

TEST(NurbsCurveTest, RationalMeansThatTheWeightsDiffer) {
  EXPECT_TRUE(unit_circle().is_rational());
  EXPECT_FALSE(line({0, 0, 0}, {1, 0, 0}).is_rational());
  const Eigen::Matrix4Xd doubled = 2 * line({0, 0, 0}, {1, 0, 0}).control_points();
  EXPECT_FALSE(NurbsCurve(KnotVector(1, {0, 0, 1, 1}), doubled).is_rational());
}

TEST(NurbsCurveTest, ClosedMeansThatTheEndsAgreeWithinTheTolerance) {
  EXPECT_TRUE(is_closed(unit_circle(), 1e-12));
  EXPECT_FALSE(is_closed(line({0, 0, 0}, {1, 0, 0}), 0.9));
  EXPECT_TRUE(is_closed(line({0, 0, 0}, {1, 0, 0}), 1.1));
}

TEST(NurbsCurveTest, TheLengthOfTheCircleIsTwoPi) {
  EXPECT_NEAR(length(unit_circle()) / (2 * std::numbers::pi), 1, 1e-14);
}

TEST(NurbsCurveTest, TheLengthOfAParabolaIsThatOfTheFormula) {
  // y = x^2 on [0, 1]; the knot at 0.3 changes nothing.
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 0.15, 0.65, 1, 0, 0, 0.3, 1, 0, 0, 0, 0;
  const NurbsCurve parabola =
      make_nurbs_curve(KnotVector(2, {0, 0, 0, 0.3, 1, 1, 1}), points, Eigen::Vector4d::Ones());
  EXPECT_NEAR(length(parabola), std::sqrt(5.0) / 2 + std::asinh(2.0) / 4, 1e-14);
}

TEST(NurbsCurveTest, TheLengthOfACurveWithACuspIsFound) {
  // (t^2, t^3) from t = -1/2 to 1 has a cusp at t = 0.
  const auto arc = [](double t) { return (std::pow(4 + 9 * t * t, 1.5) - 8) / 27; };
  Eigen::Matrix3Xd points(3, 4);
  points << 0.25, -0.25, 0, 1, -0.125, 0.25, -0.5, 1, 0, 0, 0, 0;
  const NurbsCurve curve =
      make_nurbs_curve(KnotVector(3, {-0.5, -0.5, -0.5, -0.5, 1, 1, 1, 1}), points, Eigen::Vector4d::Ones());
  EXPECT_NEAR(length(curve), arc(0.5) + arc(1), 1e-13);
}

TEST(NurbsCurveTest, WrongCountsWeightsAndValuesAreRefused) {
  const KnotVector knots(1, {0, 0, 1, 1});
  Eigen::Matrix4Xd points = line({0, 0, 0}, {1, 0, 0}).control_points();
  EXPECT_THROW(NurbsCurve(KnotVector(1, {0, 0, 1, 2, 2}), points), std::invalid_argument);
  points(3, 1) = 0;
  EXPECT_THROW(NurbsCurve(knots, points), std::invalid_argument);
  points(3, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(NurbsCurve(knots, points), std::invalid_argument);
  EXPECT_THROW(make_nurbs_curve(knots, Eigen::Matrix3Xd::Zero(3, 2), Eigen::Vector3d::Ones()),
               std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
