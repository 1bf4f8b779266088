#include "nurbs/bezier_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "nurbs/closest_point.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

/// Largest distance between the path and the curve at equal parameters.
double parametric_distance(const BezierPath& path, const NurbsCurve& curve) {
  double largest = 0;
  for (std::size_t j = 0; j < path.segments.size(); ++j)
    for (int i = 0; i <= 20; ++i) {
      const double t = 0.05 * i;
      const double u = path.breaks[j] + t * (path.breaks[j + 1] - path.breaks[j]);
      largest = std::max(largest, (path.segments[j].point(t) - curve.point(u)).norm());
    }
  return largest;
}

TEST(BezierPathTest, CurvesUpToDegreeThreeAreConvertedExactly) {
  Generator generator(30);
  for (int i = 0; i < 2000; ++i) {
    const NurbsCurve curve = random_nurbs(generator, 1 + i % 3, i % 4 > 1, i % 2 == 0);
    const BezierPath path = BezierPath::from_nurbs(curve, 0);
    ASSERT_LE(parametric_distance(path, curve), 1e-13);
    ASSERT_EQ(path.deviation, 0);
    ASSERT_TRUE(std::is_sorted(path.breaks.begin(), path.breaks.end()));
    ASSERT_EQ(path.breaks.front(), curve.knots().start());
    ASSERT_EQ(path.breaks.back(), curve.knots().end());
    for (std::size_t j = 1; j < path.segments.size(); ++j)
      ASSERT_LE((path.segments[j].control_point(0) - path.segments[j - 1].control_point(3)).norm(), 2e-15);
  }
}

TEST(BezierPathTest, ACircleIsFourArcsClampedOrPeriodic) {
  for (const NurbsCurve& circle : {unit_circle(), unit_circle(-1, 5)}) {
    const BezierPath path = BezierPath::from_nurbs(circle, 1e-6);
    ASSERT_EQ(path.segments.size(), 4u);
    for (const RationalCubic& arc : path.segments)
      for (int i = 0; i <= 100; ++i) EXPECT_NEAR(arc.point(0.01 * i).norm(), 1, 1e-15);
    EXPECT_NEAR(path.length() / (2 * pi), 1, 1e-14);
    EXPECT_TRUE(path.corners(1e-12).empty());
  }
}

TEST(BezierPathTest, APolylineIsOneStraightCubicPerPieceWithItsCorners) {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 1, 1, 2, 0, 0, 1, 2, 0, 0, 0, 0;
  const NurbsCurve polyline =
      make_nurbs_curve(KnotVector(1, {0, 0, 1, 2, 3, 3}), points, Eigen::Vector4d::Ones());
  const BezierPath path = BezierPath::from_nurbs(polyline, 0);
  ASSERT_EQ(path.segments.size(), 3u);
  EXPECT_LE((path.segments[0].control_point(1) - Eigen::Vector3d(1.0 / 3, 0, 0)).norm(), 1e-15);
  const std::vector<Corner> corners = path.corners(0.01);
  ASSERT_EQ(corners.size(), 2u);
  EXPECT_EQ(corners[0].after_segment, 0);
  EXPECT_EQ(corners[0].point, Eigen::Vector3d(1, 0, 0));
  EXPECT_NEAR(corners[0].angle, pi / 2, 1e-15);
  EXPECT_EQ(corners[1].after_segment, 1);
  EXPECT_NEAR(corners[1].angle, pi / 4, 1e-15);
  EXPECT_EQ(path.corners(1).size(), 1u);
  EXPECT_NEAR(path.length(), 2 + std::sqrt(2.0), 1e-14);
}

TEST(BezierPathTest, ACornerIsSeenThroughDoubleControlPoints) {
  Eigen::Matrix3Xd points(3, 7);
  points << 0, 1, 2, 2, 2, 2, 2, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 0, 0, 0;
  const NurbsCurve curve =
      make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2}), points, Eigen::VectorXd::Ones(7));
  const std::vector<Corner> corners = BezierPath::from_nurbs(curve, 0).corners(0.1);
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_NEAR(corners[0].angle, pi / 2, 1e-15);
}

TEST(BezierPathTest, RationalPiecesAreSplitUntilNoneTurnsByMoreThanARightAngle) {
  for (const double degrees : {60.0, 90.0, 91.0, 120.0, 175.0}) {
    const BezierPath path = BezierPath::from_nurbs(circular_arc(2, degrees * pi / 180), 0);
    ASSERT_EQ(path.segments.size(), degrees > 90 ? 2u : 1u) << degrees;
    for (const RationalCubic& arc : path.segments) {
      const Eigen::Vector3d a = arc.derivatives(0).col(1), b = arc.derivatives(1).col(1);
      EXPECT_GE(a.dot(b), -1e-14 * a.norm() * b.norm());
    }
    EXPECT_NEAR(path.length(), 2 * degrees * pi / 180, 1e-14);
    EXPECT_LE(parametric_distance(path, circular_arc(2, degrees * pi / 180)), 4e-15);
  }
}

TEST(BezierPathTest, RationalPiecesAreSplitWhereTheirTangentsTurnByMore) {
  Generator generator(7);
  int whole = 0, split = 0;
  for (int k = 0; k < 400; ++k) {
    Eigen::Matrix4d points;
    for (int i = 0; i < 4; ++i) {
      const double weight = 1 + 0.2 * i;
      points.col(i) << weight * (Eigen::Vector3d(0.8 * i, 0, 0) + random_point(generator)), weight;
    }
    const RationalCubic cubic(points);
    double turning = 0;
    for (int i = 0; i < 32; ++i) {
      const Eigen::Vector3d a = cubic.derivatives(i / 32.0).col(1),
                            b = cubic.derivatives((i + 1) / 32.0).col(1);
      turning += std::atan2(a.cross(b).norm(), a.dot(b));
    }
    const bool stays =
        BezierPath::from_nurbs({KnotVector(3, {0, 0, 0, 0, 1, 1, 1, 1}), points}, 0).segments.size() == 1;
    EXPECT_EQ(stays, turning <= 91 * pi / 180) << turning;
    ++(stays ? whole : split);
  }
  EXPECT_GT(whole, 20);
  EXPECT_GT(split, 20);
}

TEST(BezierPathTest, ToNurbsAndBackGivesTheSameSegmentsUpToAFactorEach) {
  Generator generator(31);
  for (int i = 0; i < 2000; ++i) {
    const BezierPath path = random_path(generator, 1 + i % 40);
    const NurbsCurve curve = path.to_nurbs();
    ASSERT_EQ(curve.degree(), 3);
    const BezierPath back = BezierPath::from_nurbs(curve, 0);
    ASSERT_EQ(back.breaks, path.breaks);
    for (std::size_t j = 0; j < path.segments.size(); ++j) {
      const double factor = path.segments[j].weight(0) / back.segments[j].weight(0);
      ASSERT_LE((factor * back.segments[j].points() - path.segments[j].points()).norm(),
                1e-13 * path.segments[j].points().norm());
    }
  }
}

TEST(BezierPathTest, FromNurbsAndBackIsTheSameCurve) {
  Generator generator(32);
  for (int i = 0; i < 1000; ++i) {
    const NurbsCurve curve = random_nurbs(generator, 1 + i % 3, i % 4 > 1, i % 2 == 0);
    const NurbsCurve back = BezierPath::from_nurbs(curve, 0).to_nurbs();
    for (int k = 0; k < 20; ++k) {
      const double u = uniform(generator, curve.knots().start(), curve.knots().end());
      ASSERT_LE((back.point(u) - curve.point(u)).norm(), 1e-13);
    }
  }
}

TEST(BezierPathTest, APathWithoutSegmentsOrWithTheWrongBreaksIsNotWritten) {
  Generator generator(33);
  BezierPath path = random_path(generator, 2);
  path.breaks.pop_back();
  EXPECT_THROW(path.to_nurbs(), std::invalid_argument);
  EXPECT_THROW((BezierPath{{}, {0}, 0}.to_nurbs()), std::invalid_argument);
}

TEST(BezierPathTest, HigherDegreesAreApproximatedWithinTheToleranceAtAnySampledPlace) {
  Generator generator(34);
  for (int i = 0; i < 12; ++i) {
    const NurbsCurve curve = random_nurbs(generator, 4 + i % 3, i % 2 == 0, i % 4 < 2);
    const double tolerance = 1e-5;
    const BezierPath path = BezierPath::from_nurbs(curve, tolerance);
    double largest = 0;
    const double a = curve.knots().start(), b = curve.knots().end();
    for (int k = 0; k <= 1000; ++k)
      largest = std::max(largest, closest_point(path.segments, curve.point(a + (b - a) * 1e-3 * k)).distance);
    EXPECT_LE(largest, path.deviation * (1 + 1e-6) + 1e-15);
    EXPECT_LE(path.deviation, tolerance);
    EXPECT_GT(path.deviation, 0);
  }
}

/// (u, u^4 / 4) on [0, 1].
NurbsCurve quartic() {
  Eigen::Matrix3Xd points(3, 5);
  points << 0, 0.25, 0.5, 0.75, 1, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, 0;
  return make_nurbs_curve(KnotVector(4, {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}), points, Eigen::VectorXd::Ones(5));
}

TEST(BezierPathTest, TheDeviationOfAQuarticIsThatOfTheFormula) {
  // Hermite interpolation of u^4/4 misses it by u^2 (1-u)^2 / 4 upwards; 1/64 at the middle.
  const BezierPath path = BezierPath::from_nurbs(quartic(), 1);
  ASSERT_EQ(path.segments.size(), 1u);
  EXPECT_NEAR(path.deviation, 1.0 / 64, 1e-3 / 64);
}

TEST(BezierPathTest, AQuarticNeedsAsManyPiecesAsTheFormulaSays) {
  // On an interval of length h the largest error is h^4 / 64.
  for (const double tolerance : {1e-2, 1e-3, 3e-5, 1e-7, 1e-9}) {
    const BezierPath path = BezierPath::from_nurbs(quartic(), tolerance);
    EXPECT_EQ(path.segments.size(), std::size_t(std::ceil(std::pow(64 * tolerance, -0.25) * (1 - 1e-3))));
    EXPECT_LE(path.deviation, tolerance);
  }
}

TEST(BezierPathTest, KnotsThatDoNotShowCostNoPieces) {
  // The same quartic with three more knots: de Boor points f(t_{i+1}, .., t_{i+4}) of (u, u^4/4), whose polar
  // form is (mean, product / 4).
  const std::vector<double> knots{0, 0, 0, 0, 0, 0.1, 0.5, 0.55, 1, 1, 1, 1, 1};
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 8);
  for (int i = 0; i < 8; ++i) {
    const double* t = knots.data() + i + 1;
    points(0, i) = (t[0] + t[1] + t[2] + t[3]) / 4;
    points(1, i) = t[0] * t[1] * t[2] * t[3] / 4;
  }
  const NurbsCurve curve = make_nurbs_curve(KnotVector(4, knots), points, Eigen::VectorXd::Ones(8));
  EXPECT_EQ(BezierPath::from_nurbs(curve, 1e-4).segments.size(),
            BezierPath::from_nurbs(quartic(), 1e-4).segments.size());
}

TEST(BezierPathTest, ACornerOfAQuarticStaysHoweverLooseTheTolerance) {
  Eigen::Matrix3Xd points(3, 9);
  points << 0, 1, 2, 3, 4, 4, 4, 4, 4, 0, 0, 0, 0, 0, 1, 2, 3, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0;
  const NurbsCurve curve = make_nurbs_curve(KnotVector(4, {0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 2}), points,
                                            Eigen::VectorXd::Ones(9));
  const BezierPath path = BezierPath::from_nurbs(curve, 100);
  ASSERT_EQ(path.segments.size(), 2u);
  EXPECT_EQ(path.corners(1).size(), 1u);
}

TEST(BezierPathTest, TheDeviationFallsWithTheFourthPowerOfThePieces) {
  const auto coarse = static_cast<double>(BezierPath::from_nurbs(quartic(), 3e-5).segments.size());
  const auto fine = static_cast<double>(BezierPath::from_nurbs(quartic(), 3e-5 / 256).segments.size());
  EXPECT_NEAR(fine / coarse, 4, 0.5);
}

TEST(BezierPathTest, AnApproximatedCurveHasNoCorners) {
  const BezierPath path = BezierPath::from_nurbs(quartic(), 1e-7);
  EXPECT_GT(path.segments.size(), 8u);
  EXPECT_TRUE(path.corners(1e-12).empty());
}

TEST(BezierPathTest, ACubicWrittenWithDegreeFiveIsFoundAgain) {
  Generator generator(35);
  const RationalCubic cubic = random_path(generator, 1).segments.front();
  Eigen::Matrix4Xd points = cubic.points();
  for (int p = 4; p <= 5; ++p) {
    Eigen::Matrix4Xd higher(4, p + 1);
    higher.col(0) = points.col(0);
    higher.col(p) = points.col(p - 1);
    for (int j = 1; j < p; ++j)
      higher.col(j) = (double(j) * points.col(j - 1) + double(p - j) * points.col(j)) / p;
    points = higher;
  }
  const NurbsCurve curve(KnotVector(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}), points);
  const BezierPath path = BezierPath::from_nurbs(curve, 1e-12);
  ASSERT_EQ(path.segments.size(), 1u);
  EXPECT_LE((path.segments[0].points() - cubic.points()).norm(), 1e-14);
  EXPECT_LE(path.deviation, 1e-14);
}

TEST(BezierPathTest, AToleranceBelowRoundOffStillEnds) {
  const BezierPath path = BezierPath::from_nurbs(quartic(), 1e-30);
  EXPECT_LE(path.deviation, 1e-14);
  EXPECT_LT(path.segments.size(), 5000u);
}

TEST(BezierPathTest, HigherDegreesShareTheirTangentsWhereTheSourceHasAKinkThatIsNoCorner) {
  // Two pieces of degree 5 that meet at a full knot at this angle.
  const auto bent = [](double angle) {
    Eigen::Matrix3Xd points(3, 11);
    for (int i = 0; i < 11; ++i) {
      const double x = i - 5, side = i > 5 ? std::tan(angle) * x : 0;
      points.col(i) << x, 0.05 * x * x * x * x * (i % 3) + side, 0.02 * x * x * x;
    }
    points.col(4) << -1, 0, 0;
    points.col(6) << std::cos(angle), std::sin(angle), 0;
    return make_nurbs_curve(KnotVector(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2}), points,
                            Eigen::VectorXd::Ones(11));
  };
  const double tolerance = 1e-5;
  for (const double angle : {1e-12, 1e-9, 1e-6}) {
    const NurbsCurve source = bent(angle);
    const BezierPath path = BezierPath::from_nurbs(source, tolerance);
    EXPECT_TRUE(path.corners(1e-14).empty()) << angle;
    EXPECT_LE(path.deviation, tolerance);
    const auto on_source = [&](double t) { return source.point(2 * t); };
    EXPECT_LE(largest_distance(on_source, path.segments), path.deviation);
  }
  const std::vector<Corner> kept = BezierPath::from_nurbs(bent(1e-3), tolerance).corners(1e-9);
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_NEAR(kept[0].angle, 1e-3, 1e-9);
}

TEST(BezierPathTest, APositiveToleranceIsAskedOfHigherDegreesOnly) {
  EXPECT_THROW(BezierPath::from_nurbs(quartic(), 0), std::invalid_argument);
  EXPECT_THROW(BezierPath::from_nurbs(quartic(), std::nan("")), std::invalid_argument);
  EXPECT_NO_THROW(BezierPath::from_nurbs(unit_circle(), 0));
}

}  // namespace
}  // namespace nurbeam
