#include "nurbs/bent_lines.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "nurbs/bezier_path.h"

namespace nurbeam::of_bent_lines {
namespace {

using std::numbers::pi;

const std::vector<Eigen::Vector3d> tube{{0, 0, 0}, {1, 0, 0}, {1, 0.8, 0}, {1, 1.4, 0.6}};

double length_of(const std::vector<RationalCubic>& cubics) { return total_length(cubics); }

double curvature(const RationalCubic& cubic, double u) {
  const auto d = cubic.derivatives(u);
  return d.col(1).cross(d.col(2)).norm() / std::pow(d.col(1).norm(), 3);
}

// Each corner of turn a takes 2 r tan(a/2) of its lines, and gives r a.
TEST(BentLines, HaveTheLengthOfLinesAndArcs) {
  const double r = 0.15, a = pi / 2, b = pi / 4;
  const double right =
      1 + 0.8 + 0.6 * std::sqrt(2) - 2 * r * (std::tan(a / 2) + std::tan(b / 2)) + r * (a + b);
  EXPECT_NEAR(length_of(bent_line_cubics({tube, {r}})), right, 1e-12);
  const double s = 0.3;
  const double uneven =
      1 + 0.8 + 0.6 * std::sqrt(2) - 2 * (r * std::tan(a / 2) + s * std::tan(b / 2)) + r * a + s * b;
  EXPECT_NEAR(length_of(bent_line_cubics({tube, {r, s}})), uneven, 1e-12);
}

TEST(BentLines, AreStraightOrCurvedByOneOverTheRadius) {
  const double r = 0.15;
  int arcs = 0;
  const auto cubics = bent_line_cubics({tube, {r}});
  for (const RationalCubic& cubic : cubics) {
    const bool bends = curvature(cubic, 0.5) > 1e-6;
    arcs += bends;
    for (const double u : {0.0, 0.1, 0.35, 0.8, 1.0})
      EXPECT_NEAR(curvature(cubic, u), bends ? 1 / r : 0, 1e-11) << u;
  }
  EXPECT_EQ(arcs, 2);
  EXPECT_EQ(cubics.size(), 5u);
}

TEST(BentLines, TouchWhereTheyMeet) {
  const auto cubics = bent_line_cubics({tube, {0.2}});
  EXPECT_EQ(cubics.front().control_point(0), tube.front());
  EXPECT_EQ(cubics.back().control_point(3), tube.back());
  for (std::size_t i = 1; i < cubics.size(); ++i) {
    EXPECT_EQ(cubics[i].control_point(0), cubics[i - 1].control_point(3)) << i;
    const Eigen::Vector3d before = cubics[i - 1].derivatives(1).col(1).normalized(),
                          behind = cubics[i].derivatives(0).col(1).normalized();
    EXPECT_NEAR((before - behind).norm(), 0, 1e-12) << i;
  }
}

// The arcs of a stadium's ends meet the next ones without a line between.
TEST(BentLines, MayUseALineUp) {
  const std::vector<Eigen::Vector3d> u{{0, 0, 0}, {0, 1, 0}, {0.2, 1, 0}, {0.2, 0, 0}};
  const auto cubics = bent_line_cubics({u, {0.1}});
  EXPECT_EQ(cubics.size(), 4u);
  EXPECT_NEAR(length_of(cubics), 2 * 0.9 + pi * 0.1, 1e-12);
}

TEST(BentLines, AreRoundAtTheFirstPointWhereTheyAreClosed) {
  const BentLines square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}, {0.2}};
  ASSERT_FALSE(tight_bend(square));
  const auto cubics = bent_line_cubics(square);
  EXPECT_NEAR(length_of(cubics), 4 - 8 * 0.2 + 2 * pi * 0.2, 1e-12);
  EXPECT_NEAR((cubics.front().control_point(0) - cubics.back().control_point(3)).norm(), 0, 1e-15);
  EXPECT_NEAR((cubics.front().control_point(0) - Eigen::Vector3d(0.2, 0, 0)).norm(), 0, 1e-15);
}

// A point on a line is no corner, and an arc may reach beyond it only where it is none.
TEST(BentLines, PassAPointThatIsNoCorner) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  EXPECT_NEAR(length_of(bent_line_cubics({points, {0.1}})), 2 - 0.2 + 0.05 * pi, 1e-12);
}

TEST(TightBend, NamesTheCornerAndTheLargestRadiusThatIsPossible) {
  // Line 1 of 0.8 m has arcs at both ends, which take r (tan 45 + tan 22.5 degrees) of it.
  const double largest = 0.8 / (1 + std::tan(pi / 8));
  EXPECT_FALSE(tight_bend({tube, {largest * (1 - 1e-6)}}));
  const auto tight = tight_bend({tube, {0.7}});
  ASSERT_TRUE(tight);
  EXPECT_NEAR(tight->largest, largest, 1e-12);
  EXPECT_EQ(tight->corner, 0u);
  EXPECT_FALSE(tight->folds);
  const auto beside = tight_bend({tube, {0.6, 0.6}});  // 0.6 and 0.249 of 0.8
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->corner, 0u);
  EXPECT_NEAR(beside->largest, 0.8 - 0.6 * std::tan(pi / 8), 1e-12);
}

TEST(TightBend, IsThatOfALineThatGoesBackOnItself) {
  const auto back = tight_bend({{{0, 0, 0}, {1, 0, 0}, {0.2, 0, 0}}, {1e-3}});
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->folds);
}

}  // namespace
}  // namespace nurbeam::of_bent_lines
