#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/model/build_model.h"
#include "pipelines/section/cgal_geometry.h"
#include "tests/pipelines/case_text.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

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

TEST(ClosestPlace, IsThatOfTheSearchWithoutATreeAndNoSampleIsCloser) {
  Generator generator(92);
  for (const BezierPath& path : nasty_curves())
    for (int i = 0; i < 60; ++i) {
      Eigen::Vector3d point = 1.5 * random_point(generator);
      if (i % 3 == 0) point *= 1e-3;  // near the centre of the turns
      if (i % 3 == 1)
        point = path.segments[generator() % path.segments.size()].point(uniform(generator, 0, 1));
      const ClosestPoint with_tree = closest_place(path, point), without = closest_point(path, point);
      ASSERT_NEAR(with_tree.distance, without.distance, 1e-15);
      ASSERT_EQ(path.segments[with_tree.segment].point(with_tree.u), with_tree.point);
      double sampled = INFINITY;
      for (const RationalCubic& segment : path.segments)
        for (int k = 0; k <= 100; ++k) sampled = std::min(sampled, (segment.point(k / 100.0) - point).norm());
      ASSERT_LE(with_tree.distance, sampled + 1e-15);
    }
}

TEST(ClosestPlace, FarFromTheOriginOrTheCurveItIsStillFound) {
  const BezierPath circle = BezierPath::from_nurbs(unit_circle(), 0);
  EXPECT_LE((closest_place(circle, {1e6, 0, 0}).point - Eigen::Vector3d(1, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR(closest_place(circle, {0, 0, 1e6}).distance, std::hypot(1.0, 1e6), 1e-9);
}

/// A quarter circle of radius 1 m about the origin with a place named by a point.
class NearPlace : public ::testing::Test {
 protected:
  BuildReport build(const std::string& supports, const std::string& probes) {
    const CaseFileReport report = read_case_file(
        directory_.write("case.json", test::smallest_case),
        {R"(beams[0].axis={"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [0, 1, 0], "normal": [0, 0, 1]}})",
         "supports=" + supports, R"(output={"probes": )" + probes + "}"});
    return build_model(report.value.value());
  }
  test::TemporaryDirectory directory_;
};

TEST_F(NearPlace, OfASupportAndAProbeIsTheFootOfThePoint) {
  const BuildReport report =
      build(R"([{"beam": "cable", "type": "pinned", "at": {"near": [1, 1, 0], "within": "50 cm"}}])",
            R"([{"name": "p", "beam": "cable", "at": {"near": ["86.7 cm", 0.5, 0.001]}}])");
  ASSERT_TRUE(report.value);
  EXPECT_NEAR(std::get<Support>(report.value->model.constraints.at(0)).s, pi / 4, 1e-14);
  EXPECT_NEAR(report.value->probes.at(0).s, std::atan2(0.5, 0.867), 1e-14);
}

TEST_F(NearPlace, FartherThanTheLimitIsRefusedWithDistanceLimitAndFoot) {
  for (const auto& [within, limit] : {std::pair{R"(, "within": "40 cm")", "0.4 m (\"within\")"},
                                      {"", "0.01570796327 m (1 % of its length"}}) {
    const BuildReport report = build(
        R"([{"beam": "cable", "type": "pinned", "at": {"near": [1, 1, 0])" + std::string(within) + "}}]",
        "[]");
    EXPECT_FALSE(report.value);
    ASSERT_EQ(report.diagnostics.size(), 1u);
    EXPECT_NE(report.diagnostics[0].where.find("supports[0].at.near"), std::string::npos);
    for (const char* part :
         {"(1, 1, 0) m is 0.4142135624 m from beam \"cable\"", limit, "(0.7071067812, 0.7071067812, 0) m"})
      EXPECT_NE(report.diagnostics[0].message.find(part), std::string::npos) << report.diagnostics[0].message;
  }
}

}  // namespace
}  // namespace nurbeam
