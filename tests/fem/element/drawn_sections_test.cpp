#include "fem/element/drawn_sections.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "fem/element/reference_curve.h"
#include "nurbs/primitives.h"

namespace nurbeam {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using Rule = Orientation::Rule;

RationalCubic drawn_cubic(const std::array<Vector3d, 4>& P, const std::array<double, 4>& w) {
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) points.col(i) << w[i] * P[i], w[i];
  return RationalCubic(points);
}

/// A space curve that turns by 108 degrees.
ReferenceCurve bent() {
  return ReferenceCurve(
      {drawn_cubic({Vector3d(0, 0, 0), Vector3d(1, 0, 0.2), Vector3d(1.2, 1, 0.4), Vector3d(0.6, 1.5, 1.4)},
                   {1, 0.8, 1.3, 1})},
      3);
}

/// A closed space curve of two cubics that are smooth where they meet.
ReferenceCurve ring() {
  const std::array<double, 4> w{1, 0.9, 1.2, 1};
  const Vector3d a(0, 0, 0), b(1, 0.5, 0.3), along_a(0, -0.8, 0.5), along_b(0.2, 0.9, 0.4);
  return ReferenceCurve(
      {drawn_cubic({a, a + along_a, b - along_b, b}, w), drawn_cubic({b, b + along_b, a - along_a, a}, w)}, 3,
      Metric::arc_length, true);
}

void expect_triad(const DrawnSection& x, const Vector3d& t) {
  Eigen::Matrix3d triad;
  triad << x.d1, x.d2, x.t;
  EXPECT_LT((triad.transpose() * triad - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_GT(triad.determinant(), 0);
  EXPECT_LT((x.t - t).norm(), 1e-14);
}

// d1' . d2 and t x t' by differences: their error falls with the square of the step.
void expect_rates(const ReferenceCurve& curve, double s) {
  const DrawnSection here = curve.section(s);
  const auto error = [&](double h) {
    const DrawnSection after = curve.section(s + h), before = curve.section(s - h);
    return std::hypot((after.d1 - before.d1).dot(here.d2) / (2 * h) - here.twist,
                      (here.t.cross(after.t - before.t) / (2 * h) - here.curvature).norm());
  };
  const double h = 1e-3 * curve.length(), coarse = error(h), fine = error(h / 2);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_TRUE(coarse < 1e-8 || std::abs(coarse / fine - 4) < 0.1) << coarse << " " << fine;
}

class DrawnSectionsOf : public ::testing::TestWithParam<Orientation> {};

TEST_P(DrawnSectionsOf, AreTriadsThatTurnAsTheySay) {
  const ReferenceCurve curve = bent().oriented(GetParam());
  for (int i = 1; i < 20; ++i) {
    const double s = curve.length() * i / 20;
    expect_triad(curve.section(s), curve.tangent(s));
    expect_rates(curve, s);
  }
}

TEST_P(DrawnSectionsOf, TurnByTheIntegralOfTheirTwist) {
  const ReferenceCurve curve = bent().oriented(GetParam());
  const double L = curve.length();
  double sum = 0;
  constexpr int parts = 2000;
  for (int i = 0; i < parts; ++i) sum += curve.section((i + 0.5) * L / parts).twist * L / parts;
  EXPECT_NEAR(curve.section_turn(0, L), sum, 5e-4);  // the rate jumps at the ends of a table
}

INSTANTIATE_TEST_SUITE_P(
    Every, DrawnSectionsOf,
    ::testing::Values(Orientation{}, Orientation{Rule::start, {1, 1, 0.3}},
                      Orientation{Rule::up, {0, 0.2, 1}}, Orientation{Rule::frenet},
                      Orientation{Rule::start, {0, 0, 1}, {{0.2, 0.1}, {1, 2}, {1.7, 2.4}, {2.5, 2.2}}},
                      Orientation{Rule::up, {0, 0, 1}, {{0, 0}, {2.7, 6}}}));

TEST(DrawnSections, PointTheirSecondAxisWhereTheOrientationSays) {
  const DrawnSection up = bent().oriented({Rule::up, {0, 0, 2}}).section(1.3);
  EXPECT_NEAR(up.d1.z(), 0, 1e-15);
  EXPECT_GT(up.d2.z(), 0);
  const DrawnSection start = bent().oriented({Rule::start, {0, 0, 2}}).section(0);
  EXPECT_NEAR(start.d1.z(), 0, 1e-15);
  EXPECT_GT(start.d2.z(), 0);
  const ReferenceCurve arc(arc_cubics({0, 0, 0}, 2, 0, pi / 2, 1), 3);
  const DrawnSection frenet = arc.oriented({Rule::frenet}).section(1);
  EXPECT_LT((frenet.d2 + arc.position(1) / 2).norm(), 1e-14);
  const DrawnSection along_z =
      ReferenceCurve({line_cubic({0, 0, 0}, {0, 0, 1})}, 3).oriented({}).section(0.5);
  EXPECT_LT((along_z.d2 - Vector3d::UnitX()).norm(), 1e-15);
}

TEST(DrawnSections, AreTurnedByATableThatPassesItsRowsWithoutOvershooting) {
  const ReferenceCurve straight({line_cubic({0, 0, 0}, {4, 0, 0})}, 3);
  const ReferenceCurve turned = straight.oriented({Rule::start, {0, 0, 1}, {{1, 0.5}, {2, 1.5}, {3, 1.5}}});
  const auto angle = [&](double s) {
    const Vector3d d2 = turned.section(s).d2;
    return std::atan2(-d2.y(), d2.z());
  };
  EXPECT_NEAR(angle(0.2), 0.5, 1e-15);
  EXPECT_NEAR(angle(1), 0.5, 1e-15);
  EXPECT_NEAR(angle(2), 1.5, 1e-15);
  EXPECT_NEAR(angle(3.9), 1.5, 1e-15);
  for (int i = 0; i < 50; ++i) {
    EXPECT_LE(angle(1 + i / 50.0), angle(1 + (i + 1) / 50.0) + 1e-15);
    EXPECT_NEAR(angle(2 + i / 50.0), 1.5, 1e-14);
  }
  // Two rows: a straight line.
  const ReferenceCurve even = straight.oriented({Rule::start, {0, 0, 1}, {{0, 0}, {4, 10}}});
  EXPECT_NEAR(even.section(1.7).twist, 2.5, 1e-14);
}

TEST(DrawnSections, AreCarriedOverACornerByTheSmallestRotation) {
  const ReferenceCurve curve({line_cubic({0, 0, 0}, {1, 0, 0}), line_cubic({1, 0, 0}, {1, 1, 0})}, 3);
  const ReferenceCurve drawn = curve.oriented({Rule::start, {0, 1, 1}});
  EXPECT_LT((drawn.section(0.5).d2 - Vector3d(0, 1, 1).normalized()).norm(), 1e-15);
  const double corner = curve.breaks()[1];
  EXPECT_LT((drawn.section(corner, true).d2 - Vector3d(0, 1, 1).normalized()).norm(), 1e-15);
  EXPECT_LT((drawn.section(corner).d2 - Vector3d(-1, 0, 1).normalized()).norm(), 1e-15);
}

TEST(DrawnSections, CloseOnARingWhoseHolonomyIsItsTorsion) {
  const ReferenceCurve closed = ring().oriented({});
  // Parallel transport as many small smallest rotations, of second order.
  const DrawnSection first = closed.section(0);
  const auto transported = [&](int parts) {
    Vector3d d1 = first.d1;
    for (int i = 0; i < parts; ++i) {
      const Vector3d before = closed.tangent(i * closed.length() / parts);
      const Vector3d after = closed.tangent((i + 1) % parts * closed.length() / parts);
      d1 = Eigen::Quaterniond::FromTwoVectors(before, after) * d1;
    }
    return std::atan2(d1.dot(first.d2), d1.dot(first.d1));
  };
  EXPECT_GT(std::abs(closed.holonomy()), 0.1);
  EXPECT_NEAR(closed.holonomy(), transported(8000), 1e-6);
  const DrawnSection start = closed.section(0), end = closed.section(0, true);
  EXPECT_LT((start.d1 - end.d1).norm(), 1e-12);
  EXPECT_NEAR(closed.section(1).twist * closed.length(), -closed.holonomy(), 1e-14);
  EXPECT_LT((closed.section(1).d1 - closed.section(1 + closed.length()).d1).norm(), 1e-12);
}

TEST(DrawnSections, RefuseWhatMeansNothing) {
  const ReferenceCurve straight({line_cubic({0, 0, 0}, {4, 0, 0})}, 3);
  EXPECT_THROW(straight.oriented({Rule::up, {1, 0.001, 0}}), std::invalid_argument);
  EXPECT_THROW(straight.oriented({Rule::start, {1, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(straight.oriented({Rule::frenet}), std::invalid_argument);
  EXPECT_THROW(straight.oriented({Rule::start, {0, 0, 1}, {{1, 0}, {1, 2}}}), std::invalid_argument);
  EXPECT_THROW(ring().oriented({Rule::start, {}, {{0, 0}, {1, 1}}}), std::invalid_argument);
  EXPECT_NO_THROW(ring().oriented({Rule::start, {}, {{0, 0}, {1, 2 * pi}}}));
  EXPECT_THROW(ReferenceCurve({line_cubic({0, 0, 0}, {4, 0, 0})}, 2).oriented({}), std::invalid_argument);
  std::vector<RationalCubic> s_curve = arc_cubics({0, 0, 0}, 1, 0, pi / 2, 1);
  s_curve.push_back(arc_cubics({0, 2, 0}, 1, -pi / 2, -pi, 1).front());
  EXPECT_THROW(ReferenceCurve(s_curve, 3).oriented({Rule::frenet}), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
