#include "fem/forces/body_load.h"

#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"
#include "tests/fem/rigid_bodies.h"

namespace nurbeam::testing::body_load_test {

const Eigen::Vector3d value(3, -2, 5);

BeamSystem loaded(bool is_moment, bool follower) {
  ModelBuilder builder(3);
  const int body = add_tumbling_body(builder);
  const int point = builder.add_point("point", body, {1, 0, 0});
  builder.add(Force(BodyLoad{.body = is_moment ? body : point,
                             .turns = body,
                             .is_moment = is_moment,
                             .value = value,
                             .follower = follower,
                             .time = {{0, 1}, {1, 2}}}));
  return BeamSystem(builder.build());
}

TEST(BodyLoad, HasTheTangentOfItsForce) {
  std::mt19937 random(1);
  for (const bool is_moment : {false, true})
    for (const bool follower : {false, true}) {
      const BeamSystem system = loaded(is_moment, follower);
      State state = general_state(system, random);
      state.load = 0.7;
      state.t = 0.4;
      expect_tangent(the_force<3, BoundBodyLoad<3>>(system), state, random);
    }
}

// Forces and moments do their work, along turned axes where they follow the body.
TEST(BodyLoad, HasItsPowerAndWork) {
  std::mt19937 random(2);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.3, Eigen::Vector3d(1, 1, -2).normalized()));
  for (const bool is_moment : {false, true})
    for (const bool follower : {false, true}) {
      const BeamSystem system = loaded(is_moment, follower);
      const auto load = the_force<3, BoundBodyLoad<3>>(system);
      State state = drawn_state(system);
      state.load = 0.7;
      state.t = 0.4;
      put(system, state, 0, {1, 2, 3}, turn);
      const Eigen::Vector3d spin = random_vector(3, random), velocity = random_vector(3, random);
      state.v.segment<4>(system.mesh().attitudes[0]) =
          attitude::rate(state.q.segment<4>(system.mesh().attitudes[0]), spin);
      state.v.segment<3>(position_of(system, 1)) = velocity;
      const Eigen::Vector3d now = 0.7 * 1.4 * (follower ? Eigen::Vector3d(turn * value) : value);
      EXPECT_NEAR(load.power(state), now.dot(is_moment ? spin : velocity), 1e-13);
      expect_work_of_power(load, state);
      if (!is_moment) expect_same(load.force.on_body(load.at(), 1, state), now, 1e-14);
    }
}

TEST(BodyLoad, ActsOnAPointMassInThePlane) {
  ModelBuilder builder(2);
  const int body = builder.add_body("body", 1, {0, 0, 0});
  builder.add(Force(BodyLoad{.body = body, .value = {1, 2, 0}}));
  const BeamSystem system(builder.build());
  const auto load = the_force<2, BoundBodyLoad<2>>(system);
  expect_same(load.dynamics(drawn_state(system)), Eigen::Vector2d(-1, -2), 1e-15);
}

}  // namespace nurbeam::testing::body_load_test
