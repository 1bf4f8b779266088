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

TEST(FrictionLaw, TheQuadraticPartIsAgainstTheMotionBothWays) {
  const Rubbing rubbing({.coefficient = 0.3, .viscous = 2, .quadratic = 0.5});
  EXPECT_NEAR(rubbing.at(level(10, 0, 4), {0, 0, 1}).along, -3 - 2 * 4 - 0.5 * 16, 1e-12);
  EXPECT_NEAR(rubbing.at(level(-10, 0, -4), {0, 0, -1}).along, 3 + 2 * 4 + 0.5 * 16, 1e-12);
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

// A kink of a rope with tensions T1 and T2.
FrictionPoint kink(double theta, double T1, double T2) {
  const Vector3d t1(std::cos(theta / 2), 0, -std::sin(theta / 2)), t2(t1.x(), 0, -t1.z());
  return {.force = T2 * t2 - T1 * t1, .left = t1, .right = t2, .s = 0, .rate = 1, .t = 0};
}

// Of a body that slides where the rope is kinked, T2 - T1 by its law for tensions that differ by so much.
double jump(const Friction& friction, double theta, double T1, double T2) {
  return -Rubbing(friction).at(kink(theta, T1, T2), {0, 0, 1}).along;
}

TEST(FrictionLaw, AtAKinkTensionsAreThoseOfTheCapstanAtEveryWrap) {
  for (const double theta : {0.0, 1e-6, 1e-3, 0.3, std::numbers::pi / 2, 2.5, 3.1, std::numbers::pi})
    for (const double mu : {0.02, 0.15, 0.7}) {
      const double T1 = 9, T2 = T1 * std::exp(mu * theta);
      const Friction friction{.coefficient = mu, .law = Friction::Law::capstan};
      EXPECT_NEAR(jump(friction, theta, T1, T2), T2 - T1, 1e-11 * T2) << theta << " " << mu;
    }
}

TEST(FrictionLaw, AtAKinkTensionsAreThoseOfCoulomb) {
  for (const double theta : {0.3, std::numbers::pi / 2, 2.0}) {
    const double mu = 0.15, tangent = mu * std::tan(theta / 2), T1 = 9,
                 T2 = T1 * (1 + tangent) / (1 - tangent);
    EXPECT_NEAR(jump({.coefficient = mu}, theta, T1, T2), T2 - T1, 1e-11);
  }
}

// Known answer A6: 1000 N over a pulley whose bearing has a coefficient of 0.1 at a fifth of its radius.
TEST(FrictionLaw, OfABearingIsOfTheWholeForce) {
  const Friction bearing{.coefficient = 0.02, .law = Friction::Law::bearing};
  EXPECT_NEAR(jump(bearing, std::numbers::pi, 1000, 1040.81633), 40.81633, 1e-5);
  EXPECT_NEAR(jump(bearing, std::numbers::pi / 2, 1000, 1028.69292), 28.69292, 1e-5);
}

TEST(FrictionLaw, OfABrakeMayGoByItsTravel) {
  Rubbing rubbing({.force = {{0, 1}}, .force_over = {{0, 0}, {2, 10}, {3, 4}}});
  rubbing.body.start = 5;
  for (const auto& [s, force] : {std::pair{5.0, 1.0}, {6.0, 6.0}, {4.0, 6.0}, {7.5, 8.0}, {9.0, 5.0}})
    EXPECT_NEAR(rubbing.at(level(10, s, 3), {0, s, 1}).along, -force, 1e-12) << s;
  EXPECT_NEAR(rubbing.at(level(10, 6, 3), {0, 6, 1}).by_s, -5, 1e-12);
  EXPECT_NEAR(rubbing.at(level(10, 4, 3), {0, 4, 1}).by_s, 5, 1e-12);
  EXPECT_NEAR(rubbing.at(level(10, 6, -3), {0, 6, -1}).by_s, 5, 1e-12);
}

// By the force, both slopes, the place and its rate, of bodies that slide and of those that stick, with a
// kink and without one.
TEST(FrictionLaw, HasTheDerivativesOfItsForce) {
  std::mt19937 random(1);
  for (const Friction::Law law : {Friction::Law::coulomb, Friction::Law::capstan, Friction::Law::bearing})
    for (const int slides : {1, -1, 0})
      for (const bool kink : {false, true}) {
        const Rubbing rubbing({.coefficient = 0.3,
                               .law = law,
                               .force_over = {{0, 1}, {0.5, 30}},
                               .viscous = 2,
                               .quadratic = 1.5});
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
