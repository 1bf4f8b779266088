#include "fem/constraints/held_position_of_body.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::held_position_of_body_test {

const Eigen::Vector3d drawn(1, 2, 0), held(1.3, 1.8, 0);

// The second of two bodies is held, away from where it is drawn.
template <int D>
BeamSystem with_held_body(const std::optional<DisplacementTable>& motion = {}) {
  ModelBuilder builder(D);
  builder.add_body("free", 1, {0, 0, 0});
  const int ring = builder.add_body("ring", 1, drawn);
  builder.add(Constraint(HeldBody{.body = ring, .position = held, .motion = motion}));
  return BeamSystem(builder.build());
}
constexpr int free_body = 0, ring = 1;

template <int D>
void check_held_body() {
  std::mt19937 random(1);
  const BeamSystem system = with_held_body<D>();
  const auto holds = the_constraint<D, HeldPositionOfBody<D>>(system);
  State state = disturbed_state(system, random);
  // With a part of the load it is as much of the way there.
  for (const double load : {0.0, 0.4, 1.0}) {
    state.load = load;
    const Eigen::Vector3d there = drawn + load * (held - drawn);
    expect_same(holds.value(state), state.q.segment<D>(position_of(system, ring)) - there.head<D>(), 1e-14);
  }
  expect_derivatives(holds, state, random);

  const Eigen::Matrix<double, D, 1> y = random_vector(D, random);
  const Eigen::VectorXd forces = holds.forces(state, y);
  expect_same(forces.segment<D>(position_of(system, ring)), -y, 1e-14);
  expect_same(holds.constraint.on_body(ring, state, y), -y, 1e-14);
  EXPECT_EQ(forces.segment<D>(position_of(system, free_body)).norm(), 0);
  EXPECT_EQ(holds.constraint.on_body(free_body, state, y).norm(), 0);
}
TEST(HeldPositionOfBody, IsTheWayFromWhereTheBodyIsToBeAndPushesItThere) {
  check_held_body<2>();
  check_held_body<3>();
}

// Moved from there, it is pushed on and works.
template <int D>
void check_moved_body() {
  std::mt19937 random(2);
  const DisplacementTable motion({{0, Eigen::Vector3d::Zero()}, {1, {0.4, -0.2, 0}}, {3, {0.1, 0.6, 0}}});
  const BeamSystem system = with_held_body<D>(motion);
  const auto holds = the_constraint<D, HeldPositionOfBody<D>>(system);
  State state = disturbed_state(system, random);
  state.load = 1;
  state.t = 0.7;
  const Eigen::Vector3d there = held + motion.at(0.7).value;
  expect_same(holds.value(state), state.q.segment<D>(position_of(system, ring)) - there.head<D>(), 1e-14);
  expect_derivatives(holds, state, random);
  const Eigen::Matrix<double, D, 1> y = random_vector(D, random);
  expect_work(holds, state, y, y.dot(holds.rate(state.t)));
  EXPECT_GT(holds.rate(state.t).norm(), 0.1);
}
TEST(HeldPositionOfBody, FollowsAMotionAndWorks) {
  check_moved_body<2>();
  check_moved_body<3>();
}

}  // namespace nurbeam::testing::held_position_of_body_test
