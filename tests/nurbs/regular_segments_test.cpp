#include "nurbs/regular_segments.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "nurbs/arc_length.h"
#include "nurbs/closest_point.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

RationalCubic cubic(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                    const Eigen::Vector3d& d) {
  Eigen::Matrix4d points = Eigen::Matrix4d::Ones();
  points.topRows<3>() << a, b, c, d;
  return RationalCubic(points);
}

double slowest(const std::vector<RationalCubic>& segments) {
  double least = 1e300;
  for (const RationalCubic& segment : segments)
    for (double u = 0; u <= 1; u += 0.01) least = std::min(least, segment.derivatives(u).col(1).norm());
  return least;
}

TEST(RegularSegments, StayAsTheyAre) {
  Generator generator(90);
  for (int i = 0; i < 20; ++i) {
    const std::array<RationalCubic, 1> given{random_cubic(generator)};
    const RegularSegments regular = regular_segments(given, 1e-9, 1e-9);
    ASSERT_EQ(regular.segments.size(), 1u);
    EXPECT_EQ(regular.segments[0].points(), given[0].points());
    EXPECT_EQ(regular.dropped + regular.replaced, 0);
    EXPECT_EQ(regular.deviation, 0);
  }
}

TEST(RegularSegments, AreWithoutSlivers) {
  const Eigen::Vector3d o(0, 0, 0), e(1e-8, 0, 0), a(1, 0, 0), b(1, 1e-8, 0);
  const RationalCubic leg = cubic(e, {0.3, 0, 0}, {0.6, 0, 0}, a);
  const RationalCubic next = cubic(b, {1.3, 0, 0}, {1.6, 0, 0}, {2, 0, 0});
  const std::array<RationalCubic, 5> given{cubic(o, o, o, o), cubic(o, o, e, e), leg, cubic(a, a, b, b),
                                           next};
  const RegularSegments regular = regular_segments(given, 1e-7, 1e-7);
  EXPECT_EQ(regular.dropped, 3);
  ASSERT_EQ(regular.segments.size(), 2u);
  EXPECT_EQ(regular.segments[0].control_point(3), b);
  EXPECT_NEAR(regular.deviation, 1e-8, 1e-20);
  EXPECT_TRUE(regular_segments(std::array{cubic(o, o, o, o)}, 1e-7, 1e-7).segments.empty());
}

// Each of them is short, all of them are not.
TEST(RegularSegments, AreAsFarOffAsSliversOneAfterAnotherAreLongTogether) {
  const auto straight = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return cubic(a, (2 * a + b) / 3, (a + 2 * b) / 3, b);
  };
  constexpr int count = 50;
  constexpr double sliver = 1e-7;
  const auto step = [](int i) { return Eigen::Vector3d(1, i * sliver, 0); };
  std::vector<RationalCubic> given{straight({0, 0, 0}, step(0))};
  for (int i = 0; i < count; ++i) given.push_back(straight(step(i), step(i + 1)));
  given.push_back(straight(step(count), {2, count * sliver, 0}));
  given.push_back(straight({2, count * sliver, 0}, {2, (count + 1) * sliver, 0}));
  const RegularSegments regular = regular_segments(given, 1.1 * sliver, 1e-9);
  EXPECT_EQ(regular.dropped, count + 1);
  ASSERT_EQ(regular.segments.size(), 2u);
  EXPECT_NEAR(regular.deviation, count * sliver, 1e-12);
  EXPECT_LE(hausdorff_distance(given, regular.segments), 1.001 * regular.deviation);
}

TEST(RegularSegments, HaveASpeedAtTheirEnds) {
  const Eigen::Vector3d o(0, 0, 0), a(1, 0, 0);
  for (const RationalCubic& slow : {cubic(o, o, {0.6, 0.4, 0}, a), cubic(o, {0.6, 0.4, 0.1}, a, a),
                                    cubic(o, o, a, a), cubic(o, o, o, a)}) {
    const std::array<RationalCubic, 1> given{slow};
    const double tolerance = 1e-6;
    const RegularSegments regular = regular_segments(given, 1e-9, tolerance);
    EXPECT_EQ(regular.replaced, 1);
    EXPECT_LE(regular.deviation, tolerance);
    EXPECT_LE(hausdorff_distance(given, regular.segments), 1.01 * regular.deviation + 1e-12);
    EXPECT_GT(slowest(regular.segments), 1e-4);
    EXPECT_TRUE(corners_of(regular.segments, 1e-6).empty());
    EXPECT_EQ(regular.segments.front().control_point(0), o);
    EXPECT_EQ(regular.segments.back().control_point(3), a);
  }
}

}  // namespace
}  // namespace nurbeam
