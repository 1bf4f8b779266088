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

// Taken round an axis, it goes round where it is held, and a moment about the axis works.
TEST(HeldPositionOfBody, GoesRoundAnAxis) {
  std::mt19937 random(3);
  ModelBuilder builder(3);
  const int body = builder.add_body("ring", 1, held);
  const AxisTurn turn{Eigen::Vector3d(0.4, -1, 0.7).normalized(), {0.3, -0.6, 0.2}, AngleMotion([](double t) {
                        return AngleMotion::Moment{t * t + 2 * t, 2 * t + 2, 2};
                      })};
  builder.add(Constraint(BodyJoint{.name = "", .point = body, .to = Grip::at_point(held), .turn = turn}));
  const BeamSystem system(builder.build());
  const auto holds = the_constraint<3, HeldPositionOfBody<3>>(system);
  State state = disturbed_state(system, random);
  state.load = 1;
  state.t = 0.7;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(turn.angle.at(0.7).angle, turn.axis).toRotationMatrix();
  const Eigen::Vector3d there = turn.about + R * (held - turn.about);
  expect_same(holds.value(state), state.q.segment<3>(position_of(system, body)) - there, 1e-14);
  expect_derivatives(holds, state, random);
  const Eigen::Vector3d y = random_vector(3, random);
  expect_work(holds, state, y, y.dot(holds.rate(state.t)));
  EXPECT_NEAR(holds.constraint.drive(holds.in.beams(), state, y),
              turn.axis.dot((there - turn.about).cross(Eigen::Vector3d(-y))), 1e-14);
}

}  // namespace nurbeam::testing::held_position_of_body_test
