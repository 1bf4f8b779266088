#include "nurbs/joined_curve.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "nurbs/split_curve.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

Chain in_order(std::size_t count) {
  Chain chain;
  for (std::size_t i = 0; i < count; ++i) {
    chain.curves.push_back(static_cast<int>(i));
    chain.reversed.push_back(false);
  }
  return chain;
}

TEST(JoinedCurve, OfThePiecesOfACurveIsTheCurve) {
  Generator generator(12);
  for (int i = 0; i < 200; ++i) {
    const NurbsCurve curve = random_nurbs(generator, 1 + i % 7, i % 2 == 0, i % 3 > 0);
    const double start = curve.knots().start(), end = curve.knots().end();
    std::vector<NurbsCurve> pieces =
        split_at(curve, {uniform(generator, start, end), uniform(generator, start, end)});
    Chain chain = in_order(pieces.size());
    pieces[1] = pieces[1].reversed();
    chain.reversed[1] = true;
    const JoinedCurve joined = joined_curve(pieces, chain);
    EXPECT_LE(joined.gap, 1e-13);
    EXPECT_EQ(joined.curve.degree(), curve.degree());
    const double shift = joined.curve.knots().start() - start;
    for (int k = 0; k <= 50; ++k) {
      const double u = std::lerp(start, end, k / 50.0);
      ASSERT_LE((joined.curve.point(u + shift) - curve.point(u)).norm(), 1e-11) << i;
    }
  }
}

TEST(JoinedCurve, OfOtherDegreesHasTheHighestAndTheSameLength) {
  // A line into a quarter of a circle into a curve of degree 5.
  Generator generator(13);
  const NurbsCurve arc = circular_arc(1, 1.2);
  const Eigen::Vector3d from = arc.point(arc.knots().start()), to = arc.point(arc.knots().end());
  Eigen::Matrix3Xd line(3, 2), quintic(3, 6);
  line << from - Eigen::Vector3d(0, 2, 1), from;
  quintic.setRandom();
  quintic.col(0) = to;
  std::vector<double> knots(6, 3);
  knots.insert(knots.end(), 6, 4);
  const std::vector<NurbsCurve> curves{
      make_nurbs_curve(KnotVector(1, {5, 5, 7, 7}), line, Eigen::Vector2d(2, 2)), arc,
      make_nurbs_curve(KnotVector(5, knots), quintic, Eigen::VectorXd::Constant(6, 0.5))};
  const JoinedCurve joined = joined_curve(curves, in_order(3));
  EXPECT_EQ(joined.curve.degree(), 5);
  EXPECT_NEAR(length(joined.curve), length(curves[0]) + length(curves[1]) + length(curves[2]), 1e-12);
  EXPECT_LE((joined.curve.point(joined.curve.knots().end()) - quintic.col(5)).norm(), 1e-14);
}

TEST(JoinedCurve, GapsAreClosedMidwayAndTold) {
  Eigen::Matrix3Xd a(3, 2), b(3, 2);
  a << 0, 1, 0, 0, 0, 0;
  b << 1, 1, 0.002, 1, 0, 0;
  const std::vector<NurbsCurve> curves{
      make_nurbs_curve(KnotVector(1, {0, 0, 1, 1}), a, Eigen::Vector2d::Ones()),
      make_nurbs_curve(KnotVector(1, {0, 0, 1, 1}), b, Eigen::Vector2d(3, 3))};
  const JoinedCurve joined = joined_curve(curves, in_order(2));
  EXPECT_NEAR(joined.gap, 0.002, 1e-16);
  EXPECT_LE((joined.curve.point(1) - Eigen::Vector3d(1, 0.001, 0)).norm(), 1e-16);
}

TEST(JoinedCurve, AClosedChainEndsWhereItBegins) {
  std::vector<NurbsCurve> quarters = split_at(unit_circle(), {1, 2, 3});
  Eigen::Matrix4Xd points = quarters[3].control_points();
  points(1, points.cols() - 1) += 1e-6;
  quarters[3] = NurbsCurve(quarters[3].knots(), points);
  Chain chain = in_order(4);
  chain.closed = true;
  const JoinedCurve joined = joined_curve(quarters, chain);
  EXPECT_NEAR(joined.gap, 1e-6, 1e-15);
  EXPECT_TRUE(is_closed(joined.curve, 1e-15));
}

TEST(MovedCurve, IsTheImageOfEveryPoint) {
  Generator generator(14);
  const NurbsCurve curve = random_nurbs(generator, 3, true, true);
  Eigen::Matrix<double, 3, 4> map;
  map << 0, -2, 0, 5, 2, 0, 0, 6, 0, 0, -2, 7;
  const NurbsCurve moved = moved_curve(curve, map);
  for (int i = 0; i <= 20; ++i) {
    const double u = std::lerp(curve.knots().start(), curve.knots().end(), i / 20.0);
    const Eigen::Vector3d p = curve.point(u);
    EXPECT_LE((moved.point(u) - Eigen::Vector3d(5 - 2 * p.y(), 6 + 2 * p.x(), 7 - 2 * p.z())).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace nurbeam
