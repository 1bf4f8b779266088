#include "nurbs/curve_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "nurbs/bezier.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

/// A quarter of a circle about the origin, written with this degree.
NurbsCurve quarter_circle(double radius, int degree) {
  const double w = std::sqrt(0.5);
  Eigen::Matrix4Xd conic(4, 3);
  conic << radius, w * radius, 0, 0, w * radius, radius, 0, 0, 0, 1, w, 1;
  std::vector<double> knots(degree + 1, 0);
  knots.insert(knots.end(), degree + 1, 1);
  return {KnotVector(degree, std::move(knots)), elevated(conic, degree)};
}

TEST(CurveDistance, OfPointsFromACircleIsThatOfTheirRadiusInEveryDegree) {
  for (const int degree : {2, 3, 5, 9}) {
    const std::vector<NurbsCurve> circle{quarter_circle(2, degree)};
    for (const double closeness : {1e-2, 1e-6}) {
      const CurveDistance distance(circle, closeness);
      for (double angle = 0; angle <= pi / 2; angle += 0.01)
        for (const double radius : {1.2, 1.9999999, 2.0, 2.3}) {
          const Eigen::Vector3d point(radius * std::cos(angle), radius * std::sin(angle), 0);
          ASSERT_NEAR(distance.to(point), std::abs(radius - 2), 3e-15) << degree << ' ' << angle;
        }
    }
  }
}

TEST(CurveDistance, BeyondAnEndIsThatFromTheEnd) {
  const std::vector<NurbsCurve> circle{quarter_circle(2, 7)};
  const CurveDistance distance(circle, 1e-3);
  EXPECT_NEAR(distance.to({2, -3, 0}), 3, 1e-15);
  EXPECT_NEAR(distance.to({-4, 5, 0}), 5, 1e-15);
}

TEST(CurveDistance, OfTwoCirclesIsTheDifferenceOfTheirRadiiWhateverTheCloseness) {
  for (const double closeness : {1e-1, 1e-3, 1e-7})
    for (const int degree : {2, 5, 8}) {
      const std::vector<NurbsCurve> circle{quarter_circle(1, 6)};
      EXPECT_NEAR(CurveDistance(circle, closeness).largest_from(quarter_circle(1 + 1e-9, degree)), 1e-9,
                  1e-15);
    }
}

TEST(CurveDistance, FromAParabolaToItsChordIsItsHeight) {
  // (t, t (1 - t)) written with degree 6, and the line below it.
  Eigen::Matrix4Xd parabola(4, 3), line(4, 2);
  parabola << 0, 0.5, 1, 0, 0.5, 0, 0, 0, 0, 1, 1, 1;
  line << 0, 1, 0, 0, 0, 0, 1, 1;
  std::vector<double> knots(7, 0);
  knots.insert(knots.end(), 7, 1);
  const NurbsCurve high(KnotVector(6, knots), elevated(parabola, 6));
  const std::vector<NurbsCurve> chord{NurbsCurve(KnotVector(1, {0, 0, 1, 1}), line)};
  EXPECT_NEAR(CurveDistance(chord, 1e-2).largest_from(high), 0.25, 1e-15);
}

TEST(CurveDistance, AmongManyCurvesTheClosestCounts) {
  std::vector<NurbsCurve> circles;
  for (int i = 1; i <= 5; ++i) circles.push_back(quarter_circle(i, i + 1));
  const CurveDistance distance(circles, 1e-4);
  const Eigen::Vector3d along = Eigen::Vector3d(1, 2, 0).normalized();
  for (double radius = 0.6; radius < 5.4; radius += 0.05)
    EXPECT_NEAR(distance.to(radius * along), std::abs(radius - std::round(radius)), 2e-15) << radius;
}

}  // namespace
}  // namespace nurbeam
