#include "fem/element/point_pack.h"

#include <gtest/gtest.h>

#include <random>

namespace nurbeam {
namespace {

/// Curvature and gradients at several points at once are those of one point at a time.
template <int D>
void expect_the_curvature_of_each_point(CurvatureMeasure measure) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-2, 2);
  VectorLanes<D> rs, rss;
  for (int d = 0; d < D; ++d)
    for (int g = 0; g < PointPack::lanes; ++g) {
      rs[d][g] = number(random);
      rss[d][g] = g == 0 ? 1e-9 * number(random) : number(random);
    }
  const CurvatureLanes<D> K(rs, rss, measure);
  for (int g = 0; g < PointPack::lanes; ++g) {
    Eigen::Matrix<double, D, 1> first, second;
    for (int d = 0; d < D; ++d) {
      first[d] = rs[d][g];
      second[d] = rss[d][g];
    }
    const auto expected = curvature<D, Derivatives::one>(first, second, measure);
    EXPECT_NEAR(K.value[g], expected.value, 1e-14 * (1 + std::abs(expected.value)));
    for (int d = 0; d < D; ++d) {
      EXPECT_NEAR(K.by_rs[d][g], expected.gradient[d], 1e-12 * (1 + expected.gradient.norm())) << g;
      EXPECT_NEAR(K.by_rss[d][g], expected.gradient[D + d], 1e-12 * (1 + expected.gradient.norm())) << g;
    }
  }
}

TEST(PointPack, HasTheCurvatureOfEachPoint) {
  for (const CurvatureMeasure measure : {CurvatureMeasure::material, CurvatureMeasure::spatial}) {
    expect_the_curvature_of_each_point<2>(measure);
    expect_the_curvature_of_each_point<3>(measure);
  }
}

}  // namespace
}  // namespace nurbeam
