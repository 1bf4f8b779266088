#include "fem/forces/friction_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/rate_test.h"

namespace nurbeam {
namespace {

using Eigen::Vector3d;

struct Rubbing {
  Friction friction;
  FrictionOfBody body{&friction, 1000, 5, 1e-12};

  explicit Rubbing(Friction of) : friction(std::move(of)) {}
  FrictionForce at(const FrictionPoint& point, const FrictionMemory& memory) const {
    FrictionOfBody mine = body;
    mine.friction = &friction;
    return friction_force(mine, point, memory);
  }
};

FrictionPoint level(double normal, double s = 0, double rate = 0) {
  return {.force = {0.7, 0, normal}, .left = {1, 0, 0}, .right = {1, 0, 0}, .s = s, .rate = rate, .t = 0};
}

TEST(FrictionLaw, SlidesAgainstTheCoefficientTimesTheForceAcross) {
  const Rubbing rubbing({.coefficient = 0.3, .static_coefficient = 0.5, .viscous = 2});
  EXPECT_NEAR(rubbing.at(level(10, 0, 4), {0, 0, 1}).along, -3 - 2 * 4, 1e-12);
  EXPECT_NEAR(rubbing.at(level(-10, 0, -4), {0, 0, -1}).along, 3 + 2 * 4, 1e-12);
}

TEST(FrictionLaw, SticksAsASpringUpToTheStaticBound) {
  const Rubbing rubbing({.coefficient = 0.3, .static_coefficient = 0.5, .force = {{0, 1}, {2, 3}}});
  const FrictionForce held = rubbing.at(level(10, 0.004), {0.001, 0, 0});
  EXPECT_NEAR(held.along, -1000 * 0.005, 1e-12);
  EXPECT_EQ(held.memory.slides, 0);
  EXPECT_NEAR(held.memory.z, 0.005, 1e-15);
  const FrictionForce loose = rubbing.at(level(10, 0.01), {0, 0, 0});
  EXPECT_NEAR(loose.along, -(5 + 1), 1e-12);
  EXPECT_EQ(loose.memory.slides, 1);
  FrictionPoint later = level(10, 0.01);
  later.t = 1;
  EXPECT_NEAR(rubbing.at(later, {0, 0, 0}).along, -(5 + 2), 1e-12);
}

TEST(FrictionLaw, OneThatHasTurnedRoundIsHeldWhereItIs) {
  const Rubbing rubbing({.coefficient = 0.3});
  const FrictionForce turned = rubbing.at(level(10, 1, -1e-3), {0.003, 1, 1});
  EXPECT_EQ(turned.memory.slides, 0);
  EXPECT_NEAR(turned.memory.z, 0.003, 1e-15);
}

TEST(FrictionLaw, NothingThatCannotHoldHoldsNothing) {
  const Rubbing smooth(Friction{});
  const FrictionForce none = smooth.at(level(10, 0.01, 2), {0.5, 0, 0});
  EXPECT_EQ(none.along, 0);
  EXPECT_EQ(none.by_s, 0);
  EXPECT_EQ(none.by_rate, 0);
  EXPECT_EQ(none.memory.z, 0);
}

TEST(FrictionLaw, AtAKinkTensionsAreThoseOfTheCapstanOrOfCoulomb) {
  // Tensions T1, T2 along the tangents balance the force across: (T1 + T2) sin(theta/2) = F_n.
  for (const double theta : {1e-6, 0.3, std::numbers::pi / 2, 2.5}) {
    const double mu = 0.15, F_n = 7;
    const FrictionPoint kink{.force = {0, 0, F_n},
                             .left = {std::cos(theta / 2), 0, -std::sin(theta / 2)},
                             .right = {std::cos(theta / 2), 0, std::sin(theta / 2)},
                             .s = 0,
                             .rate = 1,
                             .t = 0};
    const double sum = F_n / std::sin(theta / 2);
    const auto ratio = [&](Friction::Law law) {
      const double jump = -Rubbing({.coefficient = mu, .law = law}).at(kink, {0, 0, 1}).along;
      return (sum + jump) / (sum - jump);
    };
    EXPECT_NEAR(ratio(Friction::Law::capstan), std::exp(mu * theta), 1e-9);
    const double tangent = mu * std::tan(theta / 2);
    EXPECT_NEAR(ratio(Friction::Law::coulomb), (1 + tangent) / (1 - tangent), 1e-9);
  }
}

// By the force, both slopes, the place and its rate, of bodies that slide and of those that stick, with a
// kink and without one.
TEST(FrictionLaw, HasTheDerivativesOfItsForce) {
  std::mt19937 random(1);
  for (const Friction::Law law : {Friction::Law::coulomb, Friction::Law::capstan})
    for (const int slides : {1, -1, 0})
      for (const bool kink : {false, true}) {
        const Rubbing rubbing({.coefficient = 0.3, .law = law, .viscous = 2});
        const auto any = [&](int size) { return testing::random_vector(size, random); };
        FrictionPoint at = level(slides == 0 ? 1000 : 10, 1e-3, slides == 0 ? 0.01 : 4 * slides);
        at.force += any(3);
        at.left += 0.3 * any(3);
        at.right = at.left + (kink ? 0.6 : 0) * any(3);
        const Vector3d force = any(3), left = any(3), right = kink ? Vector3d(any(3)) : left;
        const double s = 1e-3 * any(1)[0], rate = any(1)[0];
        const FrictionForce f = rubbing.at(at, {0, 0, slides});
        const auto moved = [&](double h) {
          const FrictionPoint there{.force = at.force + h * force,
                                    .left = at.left + h * left,
                                    .right = at.right + h * right,
                                    .s = at.s + h * s,
                                    .rate = at.rate + h * rate,
                                    .t = 0};
          return rubbing.at(there, {0, 0, slides}).value;
        };
        testing::expect_rate_of_number(moved, f.by_force.dot(force) + f.by_left.dot(left) +
                                                  f.by_right.dot(right) + f.by_s * s + f.by_rate * rate);
      }
}

}  // namespace
}  // namespace nurbeam
