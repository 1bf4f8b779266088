// The layer of bending at a kink of a taut beam, against its differential equation.

#include "fem/material/bending_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nurbeam {
namespace {

constexpr double EI = 0.83;

// The moment where the angle of EI phi'' = T sin(phi) has grown from nothing to `angle`: RK4 from far away.
double moment_at(double angle, double tension) {
  const double decay = std::sqrt(tension / EI), h = 1e-4 / decay;
  double phi = 1e-7, rate = decay * phi;
  const auto curve = [&](double x) { return tension / EI * std::sin(x); };
  while (phi < angle) {
    const double k1 = rate, l1 = curve(phi), k2 = rate + h / 2 * l1, l2 = curve(phi + h / 2 * k1),
                 k3 = rate + h / 2 * l2, l3 = curve(phi + h / 2 * k2), k4 = rate + h * l3,
                 l4 = curve(phi + h * k3);
    phi += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    rate += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
  }
  return EI * (rate - curve(angle) * (phi - angle) / rate);
}

TEST(BendingLayer, AtAClampSolvesItsEquation) {
  const BeamProperties rope(1e7, EI, 1);
  for (const double angle : {0.01, 0.3, 1.5})
    EXPECT_NEAR(clamp_layer(rope, angle, 3e4).moment / moment_at(angle, 3e4), 1, 1e-6) << angle;
}

TEST(BendingLayer, IsAsLargeOnBothSidesOfAKink) {
  const BeamProperties rope(1e7, EI, 1);
  for (const auto& [before, behind] : {std::pair(3e4, 3e4), std::pair(3e4, 1.2e4), std::pair(500.0, 8e3)})
    for (const double angle : {0.02, 0.8, 2.5}) {
      // The part of the angle that the side before has, by bisection.
      double least = 0, most = angle;
      for (int i = 0; i < 60; ++i) {
        const double a = (least + most) / 2;
        const bool is_more =
            clamp_layer(rope, a, before).moment > clamp_layer(rope, angle - a, behind).moment;
        (is_more ? most : least) = a;
      }
      const BendingLayer kink = kink_layer(rope, angle, before, behind);
      EXPECT_NEAR(kink.moment / clamp_layer(rope, least, before).moment, 1, 1e-9);
      EXPECT_NEAR(kink.reach, std::sqrt(EI / std::min(before, behind)), 1e-12);
    }
}

TEST(BendingLayer, OfASmallAngleIsHalfOfItTimesTheRootOfStiffnessAndTension) {
  const BeamProperties rope(1e7, EI, 1);
  EXPECT_NEAR(kink_layer(rope, 1e-3, 2e4, 2e4).moment, 0.5e-3 * std::sqrt(EI * 2e4), 1e-9);
}

TEST(BendingLayer, BendsASectionAboutTheAxisOfTheKink) {
  BeamProperties strip(1e7, 5, 1);
  strip.sections = SectionStiffness{.bending_1 = 4, .bending_2 = 1, .torsion = 1};
  const double about_1 = kink_layer(strip, 0.1, 100, 100, {1, 0}).moment,
               about_2 = kink_layer(strip, 0.1, 100, 100, {0, 1}).moment;
  EXPECT_NEAR(about_1 / about_2, 2, 1e-12);
  EXPECT_NEAR(bending_reach(strip, 100), 0.2, 1e-12);
}

// What is drawn longer than it is free has its stiffness per drawn length.
TEST(BendingLayer, KnowsTheFreeLengthOfItsBeam) {
  const BeamProperties rope(1e7, EI, 1);
  EXPECT_NEAR(kink_layer(rope.with_free_stretch(1.02), 0.1, 100, 100).moment,
              kink_layer(rope, 0.1, 100, 100).moment, 1e-12);
}

}  // namespace
}  // namespace nurbeam
