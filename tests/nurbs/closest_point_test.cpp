#include "nurbs/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

BezierPath single(const RationalCubic& cubic) { return {{cubic}, {0, 1}, 0}; }

TEST(ClosestPointTest, OnACircleItLiesInTheDirectionOfThePoint) {
  const BezierPath circle = BezierPath::from_nurbs(unit_circle(), 0);
  Generator generator(40);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d point = 2 * random_point(generator);
    const Eigen::Vector3d foot = Eigen::Vector3d(point(0), point(1), 0).normalized();
    const ClosestPoint closest = closest_point(circle, point);
    ASSERT_NEAR(closest.distance, (point - foot).norm(), 1e-15);
    ASSERT_LE((closest.point - foot).norm(), 1e-14 / point.head<2>().norm());
    ASSERT_EQ(circle.segments[closest.segment].point(closest.u), closest.point);
  }
}

TEST(ClosestPointTest, FromTheCentreOfACircleEveryPlaceIsClosest) {
  const BezierPath circle = BezierPath::from_nurbs(unit_circle(), 0);
  EXPECT_NEAR(closest_point(circle, {0, 0, 0}).distance, 1, 1e-15);
  EXPECT_NEAR(closest_point(circle, {0, 0, 2}).distance, std::sqrt(5.0), 1e-15);
  EXPECT_NEAR(closest_point(circle, {1e-16, -1e-15, 0}).distance, 1, 2e-15);
}

TEST(ClosestPointTest, NoSampleOfARandomPathIsCloser) {
  Generator generator(41);
  for (int i = 0; i < 500; ++i) {
    const BezierPath path = BezierPath::from_nurbs(random_nurbs(generator, 3, i % 2 == 0, true), 0);
    const Eigen::Vector3d point = random_point(generator);
    const ClosestPoint closest = closest_point(path, point);
    double sampled = 1e9;
    for (const RationalCubic& segment : path.segments)
      for (int k = 0; k <= 300; ++k) sampled = std::min(sampled, (segment.point(k / 300.0) - point).norm());
    ASSERT_LE(closest.distance, sampled + 1e-15);
    ASSERT_NEAR(closest.distance, sampled, 1e-2);
    ASSERT_EQ(closest.distance, (closest.point - point).norm());
  }
}

TEST(ClosestPointTest, APointOnTheCurveIsItsOwnClosest) {
  Generator generator(42);
  for (int i = 0; i < 2000; ++i) {
    const RationalCubic cubic = random_cubic(generator);
    const Eigen::Vector3d point = cubic.point(uniform(generator, 0, 1));
    ASSERT_LE(closest_point(single(cubic), point).distance, 3e-15);
  }
}

TEST(ClosestPointTest, ACurveThatIsASinglePointUpToRoundOffIsThatPoint) {
  Generator generator(44);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d place = random_point(generator), point = random_point(generator);
    Eigen::Matrix4d points = random_cubic(generator).points();
    points.topRows<3>() = place * points.row(3);
    for (const Eigen::Vector3d& from : {point, place})
      ASSERT_NEAR(closest_point(single(RationalCubic(points)), from).distance, (place - from).norm(), 1e-15);
  }
}

TEST(ClosestPointTest, TheSecondOfTwoBranchesIsFoundWhenItIsCloser) {
  // A hairpin: the nearest end control points belong to the other branch.
  const BezierPath hairpin = BezierPath::from_nurbs(circular_arc(1, 3), 0);
  EXPECT_NEAR(closest_point(hairpin, {-0.5, 1e-9, 0}).distance,
              (Eigen::Vector3d(-0.5, 1e-9, 0) - Eigen::Vector3d(std::cos(3.0), std::sin(3.0), 0)).norm(),
              1e-15);
  EXPECT_NEAR(closest_point(hairpin, {0, 0.9, 0}).distance, 0.1, 1e-15);
}

TEST(HausdorffDistanceTest, OfTwoParametrisationsOfOneCurveIsRoundOff) {
  Generator generator(43);
  for (int i = 0; i < 20; ++i) {
    const RationalCubic cubic = random_cubic(generator);
    const auto [left, right] = moebius(cubic, uniform(generator, 0.3, 3)).split(uniform(generator, 0.2, 0.8));
    EXPECT_LE(hausdorff_distance(single(cubic), BezierPath{{left, right}, {0, 0.5, 1}, 0}), 1e-14);
  }
}

TEST(HausdorffDistanceTest, OfConcentricArcsIsTheDifferenceOfRadii) {
  const BezierPath inner = BezierPath::from_nurbs(circular_arc(1, 1.2), 0);
  const BezierPath outer = BezierPath::from_nurbs(circular_arc(1 + 1e-9, 1.2), 0);
  EXPECT_NEAR(hausdorff_distance(inner, outer), 1e-9, 1e-15);
}

TEST(HausdorffDistanceTest, LooksBothWays) {
  const BezierPath part = BezierPath::from_nurbs(line({0, 0, 0}, {1, 0, 0}), 0);
  const BezierPath whole = BezierPath::from_nurbs(line({0, 0, 0}, {1.5, 0, 0}), 0);
  EXPECT_NEAR(hausdorff_distance(part, whole), 0.5, 1e-15);
  EXPECT_NEAR(hausdorff_distance(whole, part), 0.5, 1e-15);
}

TEST(HausdorffDistanceTest, AMaximumBetweenTheSamplesIsFoundToRoundOff) {
  // The parabola y = 4 h x (1 - x), with an uneven parameter, over its chord: its height h.
  Eigen::Matrix4d points;
  const double h = 0.0123;
  points << 0, 1.0 / 3, 2.0 / 3, 1, 0, 4 * h / 3, 4 * h / 3, 0, 0, 0, 0, 0, 1, 1, 1, 1;
  const BezierPath chord = BezierPath::from_nurbs(line({0, 0, 0}, {1, 0, 0}), 0);
  EXPECT_NEAR(hausdorff_distance(single(moebius(RationalCubic(points), 1.37)), chord), h, 1e-15);
}

TEST(LargestDistanceTest, OfAnyCurveToAPathIsFound) {
  const BezierPath axis = BezierPath::from_nurbs(line({0, 0, 0}, {1, 0, 0}), 0);
  const auto wave = [](double u) { return Eigen::Vector3d(u, 0.1 * std::sin(7 * u), 0.1 * u); };
  // sin^2(7 u) + u^2 is largest where 7 sin(14 u) + 2 u = 0, past the second crest: found by bisection.
  double low = 0.6, high = 0.75;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (7 * std::sin(14 * middle) + 2 * middle > 0 ? low : high) = middle;
  }
  EXPECT_NEAR(largest_distance(wave, axis), 0.1 * std::hypot(std::sin(7 * low), low), 1e-15);
}

}  // namespace
}  // namespace nurbeam
