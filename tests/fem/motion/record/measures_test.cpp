#include "fem/motion/record/measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fem/system/initial_state.h"
#include "nurbs/primitives.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

constexpr double R = 3, from = -0.9 * M_PI, to = -0.1 * M_PI;  // an arc about the origin, open above

// The arc as drawn, with its elements as exact as the drawing; in space it lies in the x-z plane.
struct Arc {
  explicit Arc(int dimension)
      : system([&] {
          BeamModel model = testing::one_beam(testing::arc_cubics({0, 0, 0}, R, from, to, 4), dimension,
                                              testing::round_bar(0.02, 7200, 2e8), 16, {{0, false}});
          return BeamSystem(model, initial_plan(model));
        }()),
        state(drawn_state(system)) {}

  static double place(double angle) { return R * (angle - from); }
  Extreme of(const Measure& measure) const { return record_measure(system, state, measure); }

  BeamSystem system;
  State state;
};

TEST(Measures, OfAnArcAreThoseOfTheCircle) {
  for (const int dimension : {2, 3}) {
    const Arc arc(dimension);
    for (const auto& [a, b] : {std::pair{-0.8, -0.2}, {-0.75, -0.4}, {-0.9, -0.1}}) {
      const double turn = (b - a) * M_PI, slope = (a + b + 1) / 2 * M_PI;  // of the chord
      const Extreme sag = arc.of(PartSag{"", 0, {Arc::place(a * M_PI)}, {Arc::place(b * M_PI)}});
      EXPECT_NEAR(sag.value, R * (1 - std::cos(turn / 2)) / std::cos(slope), 1e-4 * R) << a << " " << b;
      EXPECT_NEAR(sag.s, Arc::place((a + b) / 2 * M_PI), 1e-2 * R);
    }
    const Extreme level = arc.of(Clearance{"", 0, {{-9, -5, 0}, {9, -5, 0}}});
    EXPECT_NEAR(level.value, 5 - R, 1e-5);
    EXPECT_NEAR(level.s, Arc::place(-M_PI / 2), 1e-3);
    const double slope = 0.3;  // a hill side through (0, -6)
    const Extreme hill =
        arc.of(Clearance{"", 0, {{-10, -6 - 10 * slope, 0}, {0, -6, 0}, {10, -6 + 10 * slope, 0}}});
    EXPECT_NEAR(hill.value, 6 - R * std::sqrt(1 + slope * slope), 1e-4);
  }
}

TEST(Measures, OfAProfileUnderAPartOfTheBeamAreOfThatPart) {
  const Arc arc(2);
  // From x = 1 on, over which the circle rises.
  const Extreme part = arc.of(Clearance{"", 0, {{1, -4, 0}, {20, -4, 0}}});
  EXPECT_NEAR(part.value, 4 - std::sqrt(R * R - 1), 1e-3);
  EXPECT_TRUE(std::isnan(arc.of(Clearance{"", 0, {{50, -4, 0}, {60, -4, 0}}}).value));
  // Below the ground.
  EXPECT_NEAR(arc.of(Clearance{"", 0, {{-9, -2, 0}, {9, -2, 0}}}).value, 2 - R, 1e-5);
}

TEST(Measures, AreNoneWithoutGravityOrBelowAnUprightChord) {
  Arc arc(2);
  EXPECT_TRUE(std::isnan(arc.of(PartSag{"", 0, {Arc::place(-0.5 * M_PI)}, {Arc::place(-0.5 * M_PI)}}).value));
  BeamModel model = testing::one_beam(testing::arc_cubics({0, 0, 0}, R, -0.5 * M_PI, 0.5 * M_PI, 4), 2,
                                      testing::round_bar(0.02, 7200, 2e8), 16, {{0, false}});
  const BeamSystem upright(model, initial_plan(model));
  const Measure whole = PartSag{"", 0, {0}, {R * M_PI}};
  EXPECT_TRUE(std::isnan(record_measure(upright, drawn_state(upright), whole).value));
  model.gravity.setZero();
  const BeamSystem floating(model, initial_plan(model));
  EXPECT_TRUE(std::isnan(record_measure(floating, drawn_state(floating), whole).value));
}

}  // namespace
}  // namespace nurbeam
