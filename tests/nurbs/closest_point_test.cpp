#include "nurbs/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "nurbs/bezier_path.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

std::vector<RationalCubic> single(const RationalCubic& cubic) { return {cubic}; }

TEST(ClosestPointTest, OnACircleItLiesInTheDirectionOfThePoint) {
  const BezierPath circle = BezierPath::from_nurbs(unit_circle(), 0);
  Generator generator(40);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d point = 2 * random_point(generator);
    const Eigen::Vector3d foot = Eigen::Vector3d(point(0), point(1), 0).normalized();
    const ClosestPoint closest = closest_point(circle.segments, point);
    ASSERT_NEAR(closest.distance, (point - foot).norm(), 1e-15);
    ASSERT_LE((closest.point - foot).norm(), 1e-14 / point.head<2>().norm());
    ASSERT_EQ(circle.segments[closest.segment].point(closest.u), closest.point);
  }
}

TEST(ClosestPointTest, FromTheCentreOfACircleEveryPlaceIsClosest) {
  const BezierPath circle = BezierPath::from_nurbs(unit_circle(), 0);
  EXPECT_NEAR(closest_point(circle.segments, {0, 0, 0}).distance, 1, 1e-15);
  EXPECT_NEAR(closest_point(circle.segments, {0, 0, 2}).distance, std::sqrt(5.0), 1e-15);
  EXPECT_NEAR(closest_point(circle.segments, {1e-16, -1e-15, 0}).distance, 1, 2e-15);
}

TEST(ClosestPointTest, NoSampleOfARandomPathIsCloser) {
  Generator generator(41);
  for (int i = 0; i < 500; ++i) {
    const BezierPath path = BezierPath::from_nurbs(random_nurbs(generator, 3, i % 2 == 0, true), 0);
    const Eigen::Vector3d point = random_point(generator);
    const ClosestPoint closest = closest_point(path.segments, point);
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
  const std::vector<RationalCubic> hairpin = BezierPath::from_nurbs(circular_arc(1, 3), 0).segments;
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
    EXPECT_LE(hausdorff_distance(single(cubic), std::array{left, right}), 1e-14);
  }
}

TEST(HausdorffDistanceTest, OfConcentricArcsIsTheDifferenceOfRadii) {
  const std::vector<RationalCubic> inner = BezierPath::from_nurbs(circular_arc(1, 1.2), 0).segments;
  const std::vector<RationalCubic> outer = BezierPath::from_nurbs(circular_arc(1 + 1e-9, 1.2), 0).segments;
  EXPECT_NEAR(hausdorff_distance(inner, outer), 1e-9, 1e-15);
}

TEST(HausdorffDistanceTest, LooksBothWays) {
  const std::vector<RationalCubic> part = BezierPath::from_nurbs(line({0, 0, 0}, {1, 0, 0}), 0).segments;
  const std::vector<RationalCubic> whole = BezierPath::from_nurbs(line({0, 0, 0}, {1.5, 0, 0}), 0).segments;
  EXPECT_NEAR(hausdorff_distance(part, whole), 0.5, 1e-15);
  EXPECT_NEAR(hausdorff_distance(whole, part), 0.5, 1e-15);
}

TEST(HausdorffDistanceTest, AMaximumBetweenTheSamplesIsFoundToRoundOff) {
  // The parabola y = 4 h x (1 - x), with an uneven parameter, over its chord: its height h.
  Eigen::Matrix4d points;
  const double h = 0.0123;
  points << 0, 1.0 / 3, 2.0 / 3, 1, 0, 4 * h / 3, 4 * h / 3, 0, 0, 0, 0, 0, 1, 1, 1, 1;
  const std::vector<RationalCubic> chord = BezierPath::from_nurbs(line({0, 0, 0}, {1, 0, 0}), 0).segments;
  EXPECT_NEAR(hausdorff_distance(single(moebius(RationalCubic(points), 1.37)), chord), h, 1e-15);
}

TEST(LargestDistanceTest, OfAnyCurveToAPathIsFound) {
  const std::vector<RationalCubic> axis = BezierPath::from_nurbs(line({0, 0, 0}, {1, 0, 0}), 0).segments;
  const auto wave = [](double u) { return Eigen::Vector3d(u, 0.1 * std::sin(7 * u), 0.1 * u); };
  // sin^2(7 u) + u^2 is largest where 7 sin(14 u) + 2 u = 0, past the second crest: found by bisection.
  double low = 0.6, high = 0.75;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (7 * std::sin(14 * middle) + 2 * middle > 0 ? low : high) = middle;
  }
  EXPECT_NEAR(largest_distance(wave, axis), 0.1 * std::hypot(std::sin(7 * low), low), 1e-15);
}

/// A cubic Hermite spline through samples of a curve.
template <typename Curve>
BezierPath interpolated(const Curve& r, double from, double to, int pieces) {
  BezierPath path{{}, {0}, 0};
  const double h = (to - from) / pieces;
  const auto slope = [&](double t) -> Eigen::Vector3d { return (r(t + 1e-4 * h) - r(t - 1e-4 * h)) / 2e-4; };
  for (int i = 0; i < pieces; ++i) {
    const double a = from + i * h, b = a + h;
    Eigen::Matrix4d points = Eigen::Matrix4d::Ones();
    points.topRows<3>() << r(a), r(a) + slope(a) / 3, r(b) - slope(b) / 3, r(b);
    path.segments.emplace_back(points);
    path.breaks.push_back(i + 1);
  }
  return path;
}

/// Curves that come near to themselves: many places are almost as near as the nearest.
std::vector<BezierPath> nasty_curves() {
  const auto spiral = [](double t) {
    return Eigen::Vector3d((1 + 0.01 * t) * std::cos(t), (1 + 0.01 * t) * std::sin(t), 0);
  };
  const auto coil = [](double t) { return Eigen::Vector3d(std::cos(t), std::sin(t), 0.003 * t); };
  const auto cusp = [](double t) { return Eigen::Vector3d(t * t, t * t * t, 0.01 * t); };
  Generator generator(91);
  return {interpolated(spiral, 0, 20 * pi, 160), interpolated(coil, 0, 20 * pi, 160),
          interpolated(cusp, -1, 1, 9), BezierPath::from_nurbs(unit_circle(), 0),
          BezierPath::from_nurbs(random_nurbs(generator, 3, true, true), 0)};
}

TEST(ClosestPointTest, OfACurveThatComesNearToItselfNoSampleIsCloser) {
  Generator generator(92);
  for (const BezierPath& path : nasty_curves())
    for (int i = 0; i < 60; ++i) {
      Eigen::Vector3d point = 1.5 * random_point(generator);
      if (i % 3 == 0) point *= 1e-3;  // near the centre of the turns
      if (i % 3 == 1)
        point = path.segments[generator() % path.segments.size()].point(uniform(generator, 0, 1));
      const ClosestPoint closest = closest_point(path.segments, point);
      ASSERT_EQ(path.segments[closest.segment].point(closest.u), closest.point);
      double sampled = INFINITY;
      for (const RationalCubic& segment : path.segments)
        for (int k = 0; k <= 100; ++k) sampled = std::min(sampled, (segment.point(k / 100.0) - point).norm());
      ASSERT_LE(closest.distance, sampled + 1e-15);
    }
}

TEST(ClosestPointTest, FarFromTheOriginOrTheCurveItIsStillFound) {
  const BezierPath circle = BezierPath::from_nurbs(unit_circle(), 0);
  EXPECT_LE((closest_point(circle.segments, {1e6, 0, 0}).point - Eigen::Vector3d(1, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR(closest_point(circle.segments, {0, 0, 1e6}).distance, std::hypot(1.0, 1e6), 1e-9);
}

TEST(ClosestPointTest, AmongManyCubicsItIsThatOfTheNearestOne) {
  Generator generator(47);
  std::vector<RationalCubic> cubics;
  for (int i = 0; i < 300; ++i) cubics.push_back(random_cubic(generator));
  const ClosestPoints all(cubics);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d point = 2 * random_point(generator);
    double nearest = 1e9;
    for (const RationalCubic& cubic : cubics)
      nearest = std::min(nearest, closest_point({&cubic, 1}, point).distance);
    ASSERT_EQ(all.to(point).distance, nearest);
  }
}

// The chords stand where the arc is sampled: only between them is there a distance, the sagitta.
TEST(ClosestPointTest, AnArcIsItsSagittaFromChordsThatEndWhereItIsSampled) {
  const BezierPath circle = BezierPath::from_nurbs(unit_circle(), 0);
  const RationalCubic& arc = circle.segments[0];
  std::vector<RationalCubic> chords;
  double sagitta = 0;
  for (int i = 0; i < 32; ++i) {
    const Eigen::Vector3d a = arc.point(i / 32.0), b = arc.point((i + 1) / 32.0);
    chords.push_back(BezierPath::from_nurbs(line(a, b), 0).segments[0]);
    sagitta = std::max(sagitta, 1 - (0.5 * (a + b)).norm());
  }
  EXPECT_NEAR(hausdorff_distance({&arc, 1}, chords), sagitta, 1e-12);
}

// 2000 cubics, each sampled and compared with all.
TEST(ClosestPointTest, ManyCubicsAreAtNoDistanceFromThemselvesSoon) {
  Generator generator(48);
  std::vector<RationalCubic> cubics;
  for (int i = 0; i < 2000; ++i) {
    Eigen::Matrix4d points = random_cubic(generator).points();
    points.topRows<3>() += Eigen::Vector3d(3 * (i % 50), 3 * (i / 50), 0) * points.row(3);
    cubics.emplace_back(points);
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_LE(hausdorff_distance(cubics, cubics), 1e-12);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

}  // namespace
}  // namespace nurbeam
