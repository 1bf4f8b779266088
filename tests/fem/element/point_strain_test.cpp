#include "fem/element/point_strain.h"

#include <gtest/gtest.h>

#include <random>

#include "fem/element/lane_arithmetic.h"
#include "fem/element/point_pack.h"
#include "fem/element/point_response.h"

namespace nurbeam {
namespace {

double of(const Lanes& numbers, int lane) { return numbers[lane]; }
double of(const Lanes8& numbers, int lane) { return numbers.of(lane); }
void set(Lanes& numbers, int lane, double number) { numbers[lane] = number; }
void set(Lanes8& numbers, int lane, double number) { numbers.set(lane, number); }

/// Curvature and its derivatives at several points at once are those of one point at a time.
template <int D, class T>
void expect_the_curvature_of_each_point(int lanes, CurvatureMeasure measure) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-2, 2);
  Components<D, T> rs, rss;
  for (int d = 0; d < D; ++d)
    for (int g = 0; g < lanes; ++g) {
      set(rs[d], g, number(random));
      set(rss[d], g, g == 0 ? 1e-9 * number(random) : number(random));
    }
  const bool material = measure == CurvatureMeasure::material;
  const Curvature<D, T> K(rs, rss, material);
  const CurvatureDerivatives<D, T> derivatives(rs, rss, material);
  for (int g = 0; g < lanes; ++g) {
    Eigen::Matrix<double, D, 1> first, second;
    for (int d = 0; d < D; ++d) {
      first[d] = of(rs[d], g);
      second[d] = of(rss[d], g);
    }
    const auto expected = curvature<D>(first, second, measure);
    const double size = 1 + expected.gradient.norm();
    EXPECT_NEAR(of(K.value, g), expected.value, 1e-14 * (1 + std::abs(expected.value)));
    for (int a = 0; a < 2 * D; ++a) {
      const double gradient = of(a < D ? K.by_rs[a % D] : K.by_rss[a % D], g);
      EXPECT_NEAR(gradient, expected.gradient[a], 1e-12 * size) << g;
      EXPECT_NEAR(of(derivatives.gradient[a], g), expected.gradient[a], 1e-12 * size) << g;
      for (int b = 0; b < 2 * D; ++b)
        EXPECT_NEAR(of(derivatives.hessian[a][b], g), expected.hessian(a, b),
                    1e-12 * (1 + expected.hessian.norm()));
    }
  }
}

TEST(PointStrain, HasTheCurvatureOfEachPoint) {
  for (const CurvatureMeasure measure : {CurvatureMeasure::material, CurvatureMeasure::spatial}) {
    expect_the_curvature_of_each_point<2, Lanes>(Lanes::SizeAtCompileTime, measure);
    expect_the_curvature_of_each_point<3, Lanes>(Lanes::SizeAtCompileTime, measure);
    expect_the_curvature_of_each_point<2, Lanes8>(FixedLanes::lanes, measure);
    expect_the_curvature_of_each_point<3, Lanes8>(FixedLanes::lanes, measure);
  }
}

}  // namespace
}  // namespace nurbeam
