#include "nurbs/curve_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

TEST(CurveChain, AShuffledOutlineIsOneClosedChain) {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
  const std::vector<NurbsCurve> square{line(a, b), line(d, c), line(b, c), line(a, d)};
  const std::vector<Chain> chains = find_chains(square, 1e-9);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].closed);
  EXPECT_EQ(chains[0].curves, (std::vector<int>{0, 2, 1, 3}));
  EXPECT_EQ(chains[0].reversed, (std::vector<bool>{false, false, true, true}));
}

TEST(CurveChain, AnOpenChainStartsWithACurveInItsOwnDirection) {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(2, 1, 0), d(3, 1, 0);
  const std::vector<Chain> forwards = find_chains({line(b, c), line(d, c), line(a, b)}, 1e-9);
  ASSERT_EQ(forwards.size(), 1u);
  EXPECT_FALSE(forwards[0].closed);
  EXPECT_EQ(forwards[0].curves, (std::vector<int>{2, 0, 1}));
  EXPECT_EQ(forwards[0].reversed, (std::vector<bool>{false, false, true}));
  const std::vector<Chain> turned = find_chains({line(b, c), line(d, c), line(b, a)}, 1e-9);
  ASSERT_EQ(turned.size(), 1u);
  EXPECT_EQ(turned[0].curves, (std::vector<int>{1, 0, 2}));
  EXPECT_EQ(turned[0].reversed, (std::vector<bool>{false, true, false}));
}

TEST(CurveChain, AForkEndsThreeChainsAndACircleIsItsOwn) {
  const Eigen::Vector3d o(5, 0, 0), a(6, 0, 0), b(5, 1, 0), c(5, 0, 1), far(5, 0, 2);
  const std::vector<Chain> chains =
      find_chains({line(o, a), line(b, o), unit_circle(), line(o, c), line(c, far)}, 1e-9);
  ASSERT_EQ(chains.size(), 4u);
  EXPECT_EQ(chains[2].curves, std::vector<int>{2});
  EXPECT_TRUE(chains[2].closed);
  EXPECT_EQ(chains[3].curves, (std::vector<int>{3, 4}));
  EXPECT_FALSE(chains[3].closed);
}

TEST(CurveChain, EndsFurtherApartThanTheToleranceDoNotMeet) {
  const std::vector<NurbsCurve> curves{line({0, 0, 0}, {1, 0, 0}), line({1, 1e-4, 0}, {2, 0, 0})};
  EXPECT_EQ(find_chains(curves, 2e-4).size(), 1u);
  EXPECT_EQ(find_chains(curves, 5e-5).size(), 2u);
}

TEST(CurveChain, AnEndThatMeetsTwoOthersJoinsNeitherThoughTheyDoNotMeet) {
  const std::vector<NurbsCurve> curves{line({-1, 0, 0}, {0, 0, 0}), line({0.8, 0, 0}, {0.8, 5, 0}),
                                       line({1.6, 0, 0}, {9, 0, 0})};
  const std::vector<Chain> chains = find_chains(curves, 0.9);
  ASSERT_EQ(chains.size(), 3u);
  for (const Chain& chain : chains) EXPECT_FALSE(chain.closed);
}

TEST(CurveChain, RandomlyTurnedPiecesOfOneCurveAreJoinedAgain) {
  Generator generator(36);
  for (int i = 0; i < 200; ++i) {
    const int count = 2 + i % 6;
    const BezierPath whole = random_path(generator, count);
    std::vector<NurbsCurve> pieces;
    for (int j = 0; j < count; ++j) {
      const NurbsCurve piece =
          BezierPath{{whole.segments[j]}, {whole.breaks[j], whole.breaks[j + 1]}, 0}.to_nurbs();
      pieces.push_back(generator() % 2 == 0 ? piece.reversed() : piece);
    }
    std::shuffle(pieces.begin(), pieces.end(), generator);
    const std::vector<Chain> chains = find_chains(pieces, 1e-9);
    ASSERT_EQ(chains.size(), 1u);
    const BezierPath joined = join(pieces, chains[0], 1e-9);
    ASSERT_EQ(joined.segments.size(), whole.segments.size());
    ASSERT_NEAR(joined.breaks.back() - joined.breaks.front(), whole.breaks.back() - whole.breaks.front(),
                1e-13);
    for (int j = 0; j < count; ++j) {
      const bool forwards =
          (joined.segments[0].control_point(0) - whole.segments[0].control_point(0)).norm() < 1e-9;
      const RationalCubic& other = forwards ? joined.segments[j] : joined.segments[count - 1 - j].reversed();
      ASSERT_LE((other.point(0.3) - whole.segments[j].point(0.3)).norm(), 1e-13);
    }
  }
}

TEST(CurveChain, JoiningClosesGapsMidwayAndReportsTheShift) {
  const std::vector<NurbsCurve> curves{line({0, 0, 0}, {1, 0, 0}), line({1, 2e-6, 0}, {1, 1, 0})};
  const BezierPath path = join(curves, find_chains(curves, 1e-5).front(), 1e-9);
  EXPECT_LE((path.segments[0].control_point(3) - Eigen::Vector3d(1, 1e-6, 0)).norm(), 1e-15);
  EXPECT_EQ(path.segments[0].control_point(3), path.segments[1].control_point(0));
  EXPECT_NEAR(path.deviation, 1e-6, 1e-15);
  EXPECT_NEAR(path.corners(0.1).at(0).angle, pi / 2, 1e-12);
  EXPECT_EQ(path.breaks, (std::vector<double>{0, 1, 2}));
}

TEST(CurveChain, AGapOfRoundOffIsLeftAlone) {
  const double next = std::nextafter(2, 3);
  const std::vector<NurbsCurve> curves{line({1, 2, 2}, {2, 2, 2}), line({next, 2, 2}, {3, 3, 2})};
  const BezierPath path = join(curves, find_chains(curves, 1e-9).front(), 1e-9);
  EXPECT_EQ(path.deviation, 0);
  EXPECT_EQ(path.segments[1].control_point(0), Eigen::Vector3d(next, 2, 2));
}

TEST(CurveChain, JoiningAClosedChainClosesItsLastGapToo) {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(1, 1, 0);
  const std::vector<NurbsCurve> curves{line(a, b), line(b, c), line(c, {0, 2e-6, 0})};
  const BezierPath path = join(curves, find_chains(curves, 1e-5).front(), 1e-9);
  EXPECT_EQ(path.segments[0].control_point(0), path.segments[2].control_point(3));
  EXPECT_NEAR(path.deviation, 1e-6, 1e-15);
}

}  // namespace
}  // namespace nurbeam
