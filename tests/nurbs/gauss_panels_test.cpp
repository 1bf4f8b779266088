#include "nurbs/gauss_panels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nurbeam {
namespace {

TEST(GaussPanelsTest, TheRuleIsExactForPowersUpTo19AndNotFor20) {
  for (int power = 0; power <= 20; ++power) {
    const double integral = gauss([power](double x) { return std::pow(x, power); }, -1, 1);
    const double error = std::abs(integral - (power % 2 == 0 ? 2.0 / (power + 1) : 0));
    if (power <= 19)
      EXPECT_LE(error, 1e-15) << power;
    else
      EXPECT_GE(error, 1e-7);
  }
}

TEST(GaussPanelsTest, TheRuleOfFivePointsIsExactForPowersUpTo9AndNotFor10) {
  for (int power = 0; power <= 10; ++power) {
    const double integral = gauss_of_5([power](double x) { return std::pow(x, power); }, 1, 2);
    const double error = std::abs(integral - (std::pow(2, power + 1) - 1) / (power + 1));
    if (power <= 9)
      EXPECT_LE(error, 1e-13) << power;
    else
      EXPECT_GE(error, 1e-7);
  }
}

TEST(GaussPanelsTest, PanelsResolveAnAlmostSingularIntegrand) {
  const double a = 1e-3;
  const Panels panels = panels_of([a](double x) { return 1 / (a * a + (x - 0.3) * (x - 0.3)); }, 0, 1);
  const double exact = (std::atan(0.7 / a) + std::atan(0.3 / a)) / a;
  EXPECT_NEAR(panels.integrals.back() / exact, 1, 1e-14);
  EXPECT_EQ(panels.breaks.front(), 0);
  EXPECT_EQ(panels.breaks.back(), 1);
  EXPECT_EQ(panels.breaks.size(), panels.integrals.size());
}

TEST(GaussPanelsTest, AKinkIsIntegratedToRoundOff) {
  const double kink = 1 / std::sqrt(3.0);
  const Panels panels = panels_of([kink](double x) { return std::abs(x - kink); }, 0, 1);
  EXPECT_NEAR(panels.integrals.back(), 0.5 * (kink * kink + (1 - kink) * (1 - kink)), 1e-13);
}

TEST(GaussPanelsTest, AJumpEndsInAPanelOfTheSmallestSize) {
  const Panels panels = panels_of([](double x) { return x < 0.3 ? 0.0 : 1.0; }, 0, 1);
  EXPECT_NEAR(panels.integrals.back(), 0.7, 1e-12);
}

TEST(GaussPanelsTest, PanelsOfWhatIsRoundOffEnd) {
  const Panels panels = panels_of([](double u) { return 1 + std::fmod(1e12 * u, 1.0); }, 0, 1);
  EXPECT_LE(panels.breaks.size(), 11'000U);
  EXPECT_NEAR(panels.integrals.back(), 1.5, 0.1);
}

}  // namespace
}  // namespace nurbeam
