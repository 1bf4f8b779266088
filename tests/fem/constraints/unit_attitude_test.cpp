#include "fem/constraints/unit_attitude.h"

#include "tests/fem/bound_constraint.h"
#include "tests/fem/rigid_bodies.h"

namespace nurbeam::testing::unit_attitude_test {

TEST(UnitAttitude, IsZeroForTurnsAndHasTheDerivativesOfItsValue) {
  std::mt19937 random(1);
  ModelBuilder builder(3);
  builder.add_body("point mass", 1, {1, 1, 1});
  add_tumbling_body(builder);
  const BeamSystem system(builder.build());
  EXPECT_EQ((count_of<3, UnitAttitude>(system)), 1);
  const auto unit = the_constraint<3, UnitAttitude>(system);
  EXPECT_EQ(unit.value(drawn_state(system))[0], 0);
  State state = drawn_state(system);
  state.q.segment<4>(system.mesh().attitudes[1]) << 1, 1, 1, 1;
  EXPECT_NEAR(unit.value(state)[0], 1.5, 1e-15);
  expect_derivatives(unit, general_state(system, random), random);
}

}  // namespace nurbeam::testing::unit_attitude_test
