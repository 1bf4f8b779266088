#include "fem/material/assumed_axial.h"

#include <gtest/gtest.h>

#include <random>

#include "nurbs/gauss_panels.h"

namespace nurbeam {
namespace {

Eigen::Vector4d random_sums(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double l = std::exp(2 * unit(random));
  return {l * unit(random), unit(random), unit(random), l};
}

TEST(AssumedStrain, HasTheEndValuesAndTheMean) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector4d y = random_sums(random);
    const AssumedStrain strain(y[0], y[1], y[2], y[3]);
    EXPECT_NEAR(strain.at(0), y[1], 1e-15);
    EXPECT_NEAR(strain.at(1), y[2], 1e-15);
    EXPECT_NEAR(strain.mean_part(0, 1) * y[3], y[0], 1e-14);
    const auto at = [&](double xi) { return strain.at(xi); };
    EXPECT_NEAR(strain.mean_part(0.2, 0.7), gauss(at, 0.2, 0.7), 1e-14);
    EXPECT_NEAR(strain.carried(0.5), strain.mean_part(0, 1), 1e-15);
  }
}

TEST(AssumedAxialEnergy, IsTheIntegralOfTheStrainsSquare) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector4d y = random_sums(random);
    const AssumedStrain strain(y[0], y[1], y[2], y[3]);
    const auto square = [&](double xi) { return strain.at(xi) * strain.at(xi); };
    const double energy = 350.0 / 2 * y[3] * gauss(square, 0, 1);
    EXPECT_NEAR(AssumedAxialEnergy(350, y).value, energy, 1e-13 * energy);
  }
}

TEST(AssumedAxialEnergy, GradientAndHessianAreTheLimitsOfDifferencesAtSecondOrder) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector4d y = random_sums(random);
    const AssumedAxialEnergy at(350, y);
    const Eigen::Vector4d along = y[3] * Eigen::Vector4d::Random();
    double errors[2][2];
    for (const int k : {0, 1}) {
      const double h = k == 0 ? 1e-2 : 5e-3;
      const AssumedAxialEnergy forward(350, y + h * along), backward(350, y - h * along);
      errors[0][k] = std::abs((forward.value - backward.value) / (2 * h) - at.gradient.dot(along));
      errors[1][k] = ((forward.gradient - backward.gradient) / (2 * h) - at.hessian() * along).norm();
    }
    for (const auto& error : errors) EXPECT_NEAR(error[0] / error[1], 4, 0.1);
    EXPECT_EQ(at.hessian(), at.hessian().transpose());
  }
}

TEST(AssumedAxialEnergy, OfAConstantStrainIsThatOfTheStrainItself) {
  const double e = 0.013, l = 0.4;
  const AssumedAxialEnergy U(350, {e * l, e, e, l});
  EXPECT_DOUBLE_EQ(U.value, 350 * e * e / 2 * l);
  EXPECT_NEAR(U.gradient[0], 350 * e, 1e-14);
  EXPECT_NEAR(U.gradient[1], 0, 1e-15);
  EXPECT_NEAR(U.gradient[2], 0, 1e-15);
}

TEST(AssumedAxialDamping, IsTheStressOfTheRatesAndLosesPower) {
  std::mt19937 random(4);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector4d y = random_sums(random);
    const AssumedAxialEnergy U(7, y);
    const AssumedAxialDamping damping(7, y[3], y.head<3>());
    EXPECT_LT((damping.stress - U.gradient.head<3>()).norm(), 1e-14 * U.gradient.norm());
    EXPECT_LT((damping.by_rate - U.hessian().topLeftCorner<3, 3>()).norm(), 1e-14 * U.hessian().norm());
    EXPECT_LT((damping.by_length - U.hessian().topRightCorner<3, 1>()).norm(), 1e-13 * U.hessian().norm());
    EXPECT_GE(damping.stress.dot(y.head<3>()), 0);
  }
}

}  // namespace
}  // namespace nurbeam
