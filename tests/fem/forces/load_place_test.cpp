#include "fem/forces/load_place.h"

#include <gtest/gtest.h>

#include <numbers>

#include "nurbs/primitives.h"
#include "tests/fem/bent_beams.h"

namespace nurbeam::testing::load_place_test {

const Beam straight{.curve = ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 2)};

TEST(LoadPlace, MovesWithItsSpeed) {
  const LoadAtPlace load{.s = 0.5, .speed = 0.4};
  EXPECT_NEAR(place_of(load, straight, 1.5).value(), 1.1, 1e-15);
}

TEST(LoadPlace, IsNowhereWhereTheLoadHasLeftTheBeam) {
  const LoadAtPlace onwards{.s = 1.5, .speed = 1}, back{.s = 0.5, .speed = -1};
  EXPECT_FALSE(place_of(onwards, straight, 0.6));
  EXPECT_FALSE(place_of(back, straight, 0.6));
  EXPECT_NEAR(place_of(onwards, straight, 0.5).value(), 2, 1e-14);
  EXPECT_EQ(place_of(back, straight, 0.5), 0);
}

TEST(LoadPlace, BeyondAnEndByRoundOffIsAtTheEnd) {
  EXPECT_EQ(place_of({.s = 2 + 1e-13}, straight, 0), straight.curve.length());
  EXPECT_EQ(place_of({.s = -1e-13}, straight, 0), 0);
  EXPECT_FALSE(place_of({.s = 2 + 1e-9}, straight, 0));
}

TEST(LoadPlace, GoesOnOverTheSeamOfARing) {
  const Beam ring{.curve = ReferenceCurve(arc_cubics({0, 0, 0}, 1, 0, 2 * std::numbers::pi, 4), 2,
                                          Metric::arc_length, true)};
  const LoadAtPlace load{.s = 6, .speed = 1};
  EXPECT_NEAR(place_of(load, ring, 2).value(), 8, 1e-15);
}

}  // namespace nurbeam::testing::load_place_test
