#include "fem/element/jet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/dual.h"

namespace nurbeam {
namespace {

// Any function of both ends that uses every operation.
template <class T>
T sample(const T& a, const T& b) {
  const T s = a * b + T(2.0) * a - b / (T(1.5) + a * a);
  return (s * s - a) / (b + T(3.0)) - s;
}

using D1 = testing::Dual<double>;
using D2 = testing::Dual<D1>;
using D3 = testing::Dual<D2>;

// The derivative along directions i, j, k (0: a, 1: b) by dual numbers nested three deep.
double third(double a, double b, int i, int j, int k) {
  const auto seeded = [&](double x, int own) {
    const D1 inner{x, i == own ? 1.0 : 0.0};
    const D2 middle{inner, D1{j == own ? 1.0 : 0.0, 0.0}};
    return D3{middle, D2{D1{k == own ? 1.0 : 0.0, 0.0}, D1{0.0, 0.0}}};
  };
  return sample(seeded(a, 0), seeded(b, 1)).d.d.d;
}
double second(double a, double b, int i, int j) {
  const auto seeded = [&](double x, int own) {
    return D2{D1{x, i == own ? 1.0 : 0.0}, D1{j == own ? 1.0 : 0.0, 0.0}};
  };
  return sample(seeded(a, 0), seeded(b, 1)).d.d;
}
double first(double a, double b, int i) {
  return sample(D1{a, i == 0 ? 1.0 : 0.0}, D1{b, i == 1 ? 1.0 : 0.0}).d;
}

TEST(Jet, HoldsThePartialDerivativesOfSumsProductsAndQuotients) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const double a = unit(random), b = unit(random);
    const Jet f = sample(Jet::variable(a, 0), Jet::variable(b, 1));
    EXPECT_NEAR(f.value(), sample(a, b), 1e-14);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(f.d(i), first(a, b, i), 1e-12);
      for (int j = 0; j < 2; ++j) {
        EXPECT_NEAR(f.d(i, j), second(a, b, i, j), 1e-11);
        for (int k = 0; k < 2; ++k) EXPECT_NEAR(f.d(i, j, k), third(a, b, i, j, k), 1e-10);
      }
    }
  }
}

TEST(Jet, OfACompositionHasTheDerivativesOfTheChainRule) {
  // sin(a b): known by hand.
  const double a = 0.7, b = 1.3, x = a * b, s = std::sin(x), c = std::cos(x);
  const Jet f = compose({s, c, -s, -c}, Jet::variable(a, 0) * Jet::variable(b, 1));
  EXPECT_NEAR(f.d(0), b * c, 1e-15);
  EXPECT_NEAR(f.d(0, 1), c - x * s, 1e-15);
  EXPECT_NEAR(f.d(0, 0), -b * b * s, 1e-15);
  EXPECT_NEAR(f.d(0, 0, 1), -2 * b * s - b * b * a * c, 1e-14);
  EXPECT_NEAR(f.d(1, 1, 1), -a * a * a * c, 1e-15);
}

}  // namespace
}  // namespace nurbeam
