#include "fem/element/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nurbeam {
namespace {

// Of x^k over [0,1], less the exact value.
double error_of_power(int k) {
  double sum = 0;
  for (int g = 0; g < GaussRule::size; ++g) sum += GaussRule::weights[g] * std::pow(GaussRule::points[g], k);
  return sum - 1.0 / (k + 1);
}

TEST(GaussRule, IsExactToDegreeNineAndNotToTen) {
  for (int k = 0; k <= 9; ++k) EXPECT_NEAR(error_of_power(k), 0, 1e-16) << k;
  // The error of the next power is that of the theory: (n!)^4 / ((2n + 1) ((2n)!)^2 ...) on [0,1], n = 5.
  const double expected = std::pow(120.0, 4) / (11 * std::pow(3628800.0, 2)) * -1;
  EXPECT_NEAR(error_of_power(10), expected, 1e-3 * std::abs(expected));
}

TEST(GaussRule, IsSymmetric) {
  for (int g = 0; g < GaussRule::size; ++g) {
    EXPECT_NEAR(GaussRule::points[g] + GaussRule::points[GaussRule::size - 1 - g], 1, 1e-16);
    EXPECT_EQ(GaussRule::weights[g], GaussRule::weights[GaussRule::size - 1 - g]);
  }
}

}  // namespace
}  // namespace nurbeam
