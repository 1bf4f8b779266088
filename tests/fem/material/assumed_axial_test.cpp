#include "fem/material/assumed_axial.h"

#include <gtest/gtest.h>

#include <random>

#include "fem/element/quadrature.h"
#include "nurbs/gauss_panels.h"

namespace nurbeam {
namespace {

AssumedAxialEnergy energy_of(double EA, const Eigen::Vector4d& y, const AxialLaw& law = GreenLaw(),
                             double free = 0) {
  BeamProperties beam(EA, 1, 1);
  beam.law = law;
  return assumed_axial_energy<GaussRule>(beam, y, free);
}

std::vector<AxialLaw> nonlinear_laws() {
  return {HookeLaw(), ForceOverStretch({{-0.9, -300}, {0, 0}, {0.1, 40}, {0.6, 90}, {2, 700}})};
}

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

// Of a strain that is a polynomial of degree 4, over an element from 0.3 on that is 0.7 long.
StrainCoefficients<double> coefficients_of(const std::array<double, 5>& strain) {
  StrainCoefficients<double> e{};
  for (int g = 0; g < GaussRule::size; ++g) {
    const double xi = GaussRule::points[g];
    const auto weights = strain_weights(0.3 + 0.7 * xi, 0.7 * GaussRule::weights[g], 0.3, 0.7);
    double at = 0;
    for (int i = 4; i >= 0; --i) at = at * xi + strain[i];
    for (int k = 0; k < 5; ++k) e[k] += weights[k] * at;
  }
  return e;
}

TEST(StrainCoefficients, AddUpToTheStrain) {
  const std::array<double, 5> strain{0.3, -0.2, 0.7, 0.4, -0.9};
  const StrainCoefficients<double> e = coefficients_of(strain);
  for (const double xi : {0.0, 0.3, 1.0}) {
    double sum = 0, at = 0;
    for (unsigned k = 0; k < 5; ++k) sum += e[k] * std::legendre(k, 2 * xi - 1);
    for (int i = 4; i >= 0; --i) at = at * xi + strain[i];
    EXPECT_NEAR(sum, at, 1e-14);
  }
}

// With the mean and the other end's value the first moment takes the place of the value at an own slope; a
// quadratic is what it was.
TEST(AssumedEnds, HaveTheFirstMomentWhereASlopeIsTheElementsOwn) {
  for (const bool quadratic : {false, true}) {
    std::array<double, 5> strain{0.3, -0.2, 0.7, 0.4, -0.9};
    if (quadratic) strain[3] = strain[4] = 0;
    const double at_a = strain[0], at_b = strain[0] + strain[1] + strain[2] + strain[3] + strain[4];
    const StrainCoefficients<double> e = coefficients_of(strain);
    for (const OwnSlopes& own : {OwnSlopes{}, {true, false}, {false, true}, {true, true}}) {
      const AssumedEnds<double> ends = assumed_ends(own);
      const std::array<double, 5> of{at_a, at_b, e[0], e[1], e[2]};
      const AssumedStrain assumed(0.7 * e[0], dot(ends.a, of), dot(ends.b, of), 0.7);
      EXPECT_NEAR(assumed.c0, e[0], 1e-15);
      if (own.count() > 0) EXPECT_NEAR(assumed.c1, e[1], 1e-14);
      if (own.count() == 2) EXPECT_NEAR(assumed.c2, e[2], 1e-14);
      if (!own.at_a) EXPECT_NEAR(assumed.at(0), at_a, 1e-14);
      if (!own.at_b) EXPECT_NEAR(assumed.at(1), at_b, 1e-14);
      if (quadratic) EXPECT_NEAR(assumed.at(0.3), 0.3 - 0.2 * 0.3 + 0.7 * 0.09, 1e-14);
    }
  }
}

TEST(AssumedAxialEnergy, IsTheIntegralOfTheStrainsSquare) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector4d y = random_sums(random);
    const AssumedStrain strain(y[0], y[1], y[2], y[3]);
    const auto square = [&](double xi) { return strain.at(xi) * strain.at(xi); };
    const double energy = 350.0 / 2 * y[3] * gauss(square, 0, 1);
    EXPECT_NEAR(energy_of(350, y).value, energy, 1e-13 * energy);
  }
}

// Of a law at a free strain, by differences whose errors must fall with the square of the step.
void expect_derivatives(const AxialLaw& law, double free, double reach, double ratio) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    Eigen::Vector4d y = random_sums(random);
    y.head<3>() *= reach;
    const AssumedAxialEnergy at = energy_of(350, y, law, free);
    const Eigen::Vector4d along = y[3] * reach * Eigen::Vector4d::Random();
    double errors[2][2];
    for (const int k : {0, 1}) {
      const double h = k == 0 ? 1e-2 : 5e-3;
      const AssumedAxialEnergy forward = energy_of(350, y + h * along, law, free),
                               backward = energy_of(350, y - h * along, law, free);
      errors[0][k] = std::abs((forward.value - backward.value) / (2 * h) - at.gradient.dot(along));
      errors[1][k] = ((forward.gradient - backward.gradient) / (2 * h) - at.hessian() * along).norm();
    }
    for (const auto& error : errors) EXPECT_NEAR(error[0] / error[1], 4, ratio);
    EXPECT_EQ(at.hessian(), at.hessian().transpose());
  }
}

TEST(AssumedAxialEnergy, GradientAndHessianAreTheLimitsOfDifferencesAtSecondOrder) {
  expect_derivatives(GreenLaw(), 0, 1, 0.1);
  for (const double free : {0.0, 0.2, -0.1}) expect_derivatives(HookeLaw(), free, 0.1, 0.2);
}

// The rows of a table have jumps of the third derivative: within an interval alone differences are of second
// order.
TEST(AssumedAxialEnergy, OfATableHasItsDerivatives) {
  const ForceOverStretch table({{-0.9, -300}, {-0.5, -200}, {1.2, 500}, {2, 700}});
  for (const double free : {0.0, 0.1}) expect_derivatives(table, free, 0.1, 0.2);
}

TEST(AssumedAxialEnergy, IsTheIntegralOfTheLaw) {
  std::mt19937 random(5);
  for (const AxialLaw& law : nonlinear_laws())
    for (const double free : {0.0, 0.3}) {
      const Eigen::Vector4d y = Eigen::Vector4d(0.05, 0.1, -0.02, 0.7);
      const AssumedStrain strain(y[0], y[1], y[2], y[3]);
      const auto at = [&](double xi) { return axial_point(law, 350.0, strain.at(xi), free).energy; };
      const double energy = y[3] * gauss(at, 0, 1);
      EXPECT_NEAR(energy_of(350, y, law, free).value, energy, 1e-4 * energy);
    }
}

TEST(AssumedAxialEnergy, OfAConstantStrainIsThatOfTheStrainItself) {
  const double e = 0.013, l = 0.4;
  const AssumedAxialEnergy U = energy_of(350, {e * l, e, e, l});
  EXPECT_DOUBLE_EQ(U.value, 350 * e * e / 2 * l);
  EXPECT_NEAR(U.gradient[0], 350 * e, 1e-14);
  EXPECT_NEAR(U.gradient[1], 0, 1e-15);
  EXPECT_NEAR(U.gradient[2], 0, 1e-15);
}

TEST(AssumedAxialDamping, IsTheStressOfTheRatesAndLosesPower) {
  std::mt19937 random(4);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector4d y = random_sums(random);
    const AssumedAxialEnergy U = energy_of(7, y);
    const AssumedAxialDamping damping(BeamProperties(7, 1, 1, 1), y[3], y.head<3>());
    EXPECT_LT((damping.stress - U.gradient.head<3>()).norm(), 1e-14 * U.gradient.norm());
    EXPECT_LT((damping.by_rate - U.hessian().topLeftCorner<3, 3>()).norm(), 1e-14 * U.hessian().norm());
    EXPECT_LT((damping.by_length - U.hessian().topRightCorner<3, 1>()).norm(), 1e-13 * U.hessian().norm());
    EXPECT_GE(damping.stress.dot(y.head<3>()), 0);
  }
}

}  // namespace
}  // namespace nurbeam
