#include "fem/element/reference_curve.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "nurbs/primitives.h"

namespace nurbeam {
namespace {

// Weights far apart, curvature almost nothing, and a short one.
std::vector<RationalCubic> hard_cubics() {
  std::vector<RationalCubic> cubics;
  for (const auto& [bend, weight, size] :
       {std::tuple{0.4, 1.0, 1.0}, {0.4, 20.0, 1.0}, {0.4, 0.05, 1.0}, {1e-6, 1.3, 1.0}, {0.4, 2.0, 1e-4}}) {
    Eigen::Matrix4d points;
    points.col(0) << 0, 0, 0, 1;
    points.col(1) << weight * 0.3 * size, weight * bend * size, 0, weight;
    points.col(2) << 0.7 * size, 0.8 * bend * size, 0, 1;
    points.col(3) << size, 0, 0, 1;
    cubics.emplace_back(points);
  }
  return cubics;
}

TEST(ReferenceCurve, IsTravelledAtUnitSpeed) {
  for (const RationalCubic& cubic : hard_cubics()) {
    const ReferenceCurve curve({cubic}, 2);
    const double L = curve.length(), h = 1e-4 * L;
    for (int i = 1; i < 20; ++i) {
      const double s = L * i / 20;
      const Eigen::Vector3d difference = (8 * (curve.position(s + h) - curve.position(s - h)) -
                                          curve.position(s + 2 * h) + curve.position(s - 2 * h)) /
                                         (12 * h);
      EXPECT_NEAR(difference.norm(), 1, 1e-6);
      EXPECT_LT((difference - curve.tangent(s)).norm(), 1e-6);
      EXPECT_NEAR(curve.arc_length(0, curve.parameter(0, s)), s, 1e-12 * L);
    }
  }
}

TEST(ReferenceCurve, HasTheCurvatureAndStretchOfItsDrawingWithTheirDerivatives) {
  for (const RationalCubic& cubic : hard_cubics()) {
    const ReferenceCurve curve({cubic}, 2);
    const double h = 1e-4;
    for (const double u : {0.2, 0.5, 0.8}) {
      const ChartGeometry here = curve.geometry(0, u), after = curve.geometry(0, u + h),
                          before = curve.geometry(0, u - h);
      const auto expect_derivatives = [&](const std::array<double, 4> ChartGeometry::*values, int count) {
        double size = 0;
        for (int k = 0; k <= count; ++k) size = std::max(size, std::abs((here.*values)[k]));
        for (int k = 0; k < count; ++k)
          EXPECT_NEAR(((after.*values)[k] - (before.*values)[k]) / (2 * h), (here.*values)[k + 1],
                      2e-4 * size)
              << k;
      };
      expect_derivatives(&ChartGeometry::stretch, 3);
      expect_derivatives(&ChartGeometry::weight, 3);
      expect_derivatives(&ChartGeometry::curvature, 2);
      // The tangent turns by the curvature times the arc length.
      const double s = curve.arc_length(0, u), ds = 1e-5 * curve.length();
      const Eigen::Vector3d t = curve.tangent(s - ds), t1 = curve.tangent(s + ds);
      EXPECT_NEAR((t.x() * t1.y() - t.y() * t1.x()) / (2 * ds), here.curvature[0],
                  1e-5 * (std::abs(here.curvature[0]) + 1));
    }
  }
}

TEST(ReferenceCurve, OfAnArcHasOneCurvatureOfTheRightSign) {
  const double R = 0.7;
  const auto arc = arc_cubics({0, 0, 0}, R, 0, 1, 1);
  EXPECT_NEAR(ReferenceCurve(arc, 2).geometry(0, 0.3).curvature[0], 1 / R, 1e-12);
  EXPECT_NEAR(ReferenceCurve({arc[0].reversed()}, 2).geometry(0, 0.3).curvature[0], -1 / R, 1e-12);
  EXPECT_NEAR(ReferenceCurve({arc[0].reversed()}, 3).geometry(0, 0.3).curvature[0], 1 / R, 1e-12);
  EXPECT_NEAR(ReferenceCurve(arc, 2).length(), R, 1e-13);
}

TEST(ReferenceCurve, StraightenedKeepsItsPlacesAndLosesItsCurvatureOnly) {
  const ReferenceCurve arc(arc_cubics({0, 0, 0}, 0.7, 0, 1, 1), 2), straight = arc.straightened();
  EXPECT_TRUE(straight.straight());
  EXPECT_EQ(straight.geometry(0, 0.3).curvature, (std::array<double, 4>{}));
  EXPECT_EQ(straight.position(0.4), arc.position(0.4));
  EXPECT_EQ(straight.largest_curvature(), arc.largest_curvature());
}

TEST(ReferenceCurve, AtABreakHasATangentOnEachSide) {
  const ReferenceCurve corner({line_cubic({0, 0, 0}, {1, 0, 0}), line_cubic({1, 0, 0}, {1, 2, 0})}, 2);
  ASSERT_EQ(corner.breaks().size(), 3u);
  const double s = corner.breaks()[1];
  EXPECT_NEAR(s, 1, 1e-15);
  EXPECT_NEAR(corner.length(), 3, 1e-15);
  EXPECT_LT((corner.tangent(s, true) - Eigen::Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LT((corner.tangent(s) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_EQ(corner.next_break(0.5), s);
  EXPECT_TRUE(std::isinf(corner.next_break(s)));
}

TEST(ReferenceCurve, AtABreakIsExactlyAtTheEndOfItsSegment) {
  const Eigen::Matrix4d bend =
      (Eigen::Matrix4d() << 0, 1.3, 2, 2.4, 0, 0.1, 0.9, 2.2, 0, 0, 0, 0, 1, 1.2, 0.9, 1).finished();
  const RationalCubic cubic(bend);
  const auto [first, second] = cubic.split(0.37);
  const ReferenceCurve curve({first, second}, 2);
  for (const int j : {0, 1}) {
    EXPECT_EQ(curve.parameter(j, curve.breaks()[j]), 0);
    EXPECT_EQ(curve.parameter(j, curve.breaks()[j + 1]), 1);
  }
}

}  // namespace
}  // namespace nurbeam
