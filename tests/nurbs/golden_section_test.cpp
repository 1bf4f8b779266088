#include "nurbs/golden_section.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nurbeam {
namespace {

TEST(GoldenSectionTest, AVShapedMinimumIsFoundToRoundOff) {
  EXPECT_NEAR(minimum_place([](double x) { return std::abs(x - 0.7); }, 0, 2, 80), 0.7, 1e-15);
}

TEST(GoldenSectionTest, EachStepLeaves618ThousandthsOfTheInterval) {
  const double error = minimum_place([](double x) { return x; }, 0, 1, 10);
  EXPECT_NEAR(error, std::pow(0.6180339887498949, 12), 1e-12);
}

}  // namespace
}  // namespace nurbeam
