#include "nurbs/curve_vertices.h"

#include <gtest/gtest.h>

#include <chrono>

#include "nurbs/curve_chain.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

TEST(CurveVertices, AreTheDifferentEndsInOrderOfAppearance) {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(2, 1, 0);
  const std::vector<CurveVertex> vertices = vertices_of({line(b, a), line(b, c), line(c, b)}, 1e-9);
  ASSERT_EQ(vertices.size(), 3U);
  EXPECT_EQ(vertices[0].point, b);
  EXPECT_EQ(vertices[0].ends, (std::vector<CurveEnd>{{0, false}, {1, false}, {2, true}}));
  EXPECT_EQ(vertices[1].ends, (std::vector<CurveEnd>{{0, true}}));
  EXPECT_EQ(vertices[2].ends, (std::vector<CurveEnd>{{1, true}, {2, false}}));
}

TEST(CurveVertices, AgreeWithTheComparisonOfAllPairs) {
  Generator generator(5);
  for (int i = 0; i < 100; ++i) {
    // Coordinates on a lattice of 0.1 with noise of 1e-3: many ends meet, across the borders of cells too.
    std::vector<NurbsCurve> curves;
    const auto point = [&] {
      return Eigen::Vector3d((3 * random_point(generator)).array().round() * 0.1 +
                             1e-3 * random_point(generator).array());
    };
    for (int k = 0; k < 40; ++k) curves.push_back(line(point(), point()));
    const double tolerance = uniform(generator, 5e-4, 4e-3);
    const std::vector<Eigen::Vector3d> points = end_points(curves);
    std::vector<int> group(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) group[k] = static_cast<int>(k);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t k = 0; k < points.size(); ++k)
        for (std::size_t l = 0; l < points.size(); ++l)
          if ((points[k] - points[l]).norm() <= tolerance && group[k] < group[l]) {
            group[l] = group[k];
            changed = true;
          }
    }
    for (const CurveVertex& vertex : vertices_of(curves, tolerance))
      for (std::size_t k = 0; k < points.size(); ++k) {
        const CurveEnd end{static_cast<int>(k / 2), k % 2 == 1}, &first = vertex.ends.front();
        const bool inside = std::find(vertex.ends.begin(), vertex.ends.end(), end) != vertex.ends.end();
        ASSERT_EQ(inside, group[k] == group[2 * first.curve + (first.at_end ? 1 : 0)]);
      }
  }
}

TEST(CurveVertices, OfAHundredThousandCurvesAreFoundInASecondOrTwo) {
  std::vector<NurbsCurve> chain, star;
  for (int i = 0; i < 100'000; ++i) {
    chain.push_back(line({0.1 * i, 0, 0}, {0.1 * (i + 1), 0, 0}));
    star.push_back(line({0, 0, 0}, {std::cos(i), std::sin(i), 1}));
  }
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(find_chains(chain, 1e-6).size(), 1U);
  EXPECT_EQ(find_chains(star, 1e-9).size(), star.size());
  // All pairs would take minutes.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(CurveVertices, OfCoordinatesFarFromTheOriginKeepTheTolerance) {
  const Eigen::Vector3d far(1e6, -2e6, 3e5);
  const NurbsCurve a = line(far, far + Eigen::Vector3d(1, 0, 0));
  const NurbsCurve b = line(far + Eigen::Vector3d(1, 2e-7, 0), far + Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(vertices_of({a, b}, 1e-6).size(), 3U);
  EXPECT_EQ(vertices_of({a, b}, 1e-8).size(), 4U);
  EXPECT_EQ(vertices_of({a, a}, 0).size(), 2U);
}

}  // namespace
}  // namespace nurbeam
