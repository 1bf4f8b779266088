#include "fem/constraints/held_angle.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "tests/support/dual.h"

namespace nurbeam {
namespace {

template <int D>
using VectorOf = Eigen::Matrix<double, D, 1>;

template <int D>
VectorOf<D> random_coordinates(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return VectorOf<D>::NullaryExpr([&] { return normal(random); });
}

// The second derivative along the unit vectors i and j of (a, b) by nested dual numbers.
template <int D>
testing::Dual<testing::Dual<double>> differentiated(const HeldAngle<D>& angle, const VectorOf<D>& a,
                                                    const VectorOf<D>& b, int i, int j) {
  using Inner = testing::Dual<double>;
  using Outer = testing::Dual<Inner>;
  std::array<std::array<Outer, D>, 2> slopes;
  for (int k = 0; k < 2 * D; ++k)
    slopes[k / D][k % D] =
        Outer(Inner(k < D ? a[k] : b[k - D], k == i ? 1.0 : 0.0), Inner(k == j ? 1.0 : 0.0, 0.0));
  return angle.value(slopes[0], slopes[1]);
}

template <int D>
void check_angle_derivatives(int seed) {
  std::mt19937 random(seed);
  for (int trial = 0; trial < 50; ++trial) {
    const HeldAngle<D> angle(random_coordinates<D>(random).normalized(),
                             random_coordinates<D>(random).normalized());
    const VectorOf<D> a = random_coordinates<D>(random), b = random_coordinates<D>(random);
    const auto terms = angle.terms(a, b);
    for (int i = 0; i < 2 * D; ++i)
      for (int j = 0; j < 2 * D; ++j) {
        const auto g = differentiated<D>(angle, a, b, i, j);
        EXPECT_NEAR(terms.value, g.x.x, 1e-14 * (1 + a.norm() * b.norm()));
        EXPECT_NEAR(terms.gradient[i], g.x.d, 1e-14 * (1 + a.norm() + b.norm()));
        EXPECT_NEAR(terms.hessian(i, j), g.d.d, 1e-13 * (1 + a.norm() / b.norm() + b.norm() / a.norm()));
      }
  }
}

TEST(HeldAngle, HasTheDerivativesOfItsValueInThePlane) { check_angle_derivatives<2>(1); }
TEST(HeldAngle, HasTheDerivativesOfItsValueInSpace) { check_angle_derivatives<3>(2); }

TEST(HeldAngle, InThePlaneIsTheSineOfTheChangeOfTheAngle) {
  const Eigen::Rotation2Dd drawn(0.4), turned(1.9), opened(0.15);
  const Eigen::Vector2d a = Eigen::Vector2d::UnitX(), b = drawn * a;
  const HeldAngle<2> angle(a, b);
  EXPECT_NEAR(angle.terms(turned * a, turned * b).value, 0, 1e-15);
  EXPECT_NEAR(angle.terms(turned * (2 * a), turned * (opened * (3 * b))).value, 6 * std::sin(0.15), 1e-14);
  // Beams that are drawn in one line are held as well.
  EXPECT_NEAR(HeldAngle<2>(a, a).terms(a, opened * a).value, std::sin(0.15), 1e-15);
}

TEST(HeldAngle, InSpaceIsZeroForEveryMotionThatKeepsTheAngle) {
  std::mt19937 random(3);
  const Eigen::Vector3d a = random_coordinates<3>(random).normalized(),
                        b = random_coordinates<3>(random).normalized();
  const HeldAngle<3> angle(a, b);
  const Eigen::AngleAxisd about_a(1.1, a), any(0.7, random_coordinates<3>(random).normalized());
  EXPECT_NEAR(angle.terms(any * (1.2 * a), any * (about_a * (0.9 * b))).value, 0, 1e-15);
  EXPECT_GT(std::abs(angle.terms(a, any * b).value), 1e-3);
}

}  // namespace
}  // namespace nurbeam
