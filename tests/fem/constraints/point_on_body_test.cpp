#include "fem/constraints/point_on_body.h"

#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"
#include "tests/fem/rigid_bodies.h"

namespace nurbeam::testing::point_on_body_test {

TEST(PointOnBody, IsWhereTheTurnOfTheBodyTakesIt) {
  std::mt19937 random(1);
  ModelBuilder builder(3);
  const int body = add_tumbling_body(builder), point = builder.add_point("point", body, {0.7, -0.2, 0.9});
  const BeamSystem system(builder.build());
  const auto at = the_constraint<3, PointOnBody>(system);
  State state = drawn_state(system);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -0.5).normalized()));
  const Eigen::Vector3d r(0.4, 0.5, 0.6), arm = Eigen::Vector3d(0.7, -0.2, 0.9) - tumbling_at;
  put(system, state, body, r, turn);
  state.q.segment<3>(position_of(system, point)) = r + turn * arm;
  expect_same(at.value(state), Eigen::Vector3d::Zero(), 1e-15);
}

TEST(PointOnBody, HasTheDerivativesOfItsValueForQuaternionsOfAnyLength) {
  std::mt19937 random(2);
  ModelBuilder builder(3);
  const int body = add_tumbling_body(builder), point = builder.add_point("point", body, {0.7, -0.2, 0.9});
  const int other = builder.add_body("other", 1, {0, 0, 0});
  const BeamSystem system(builder.build());
  const auto at = the_constraint<3, PointOnBody>(system);
  const State state = general_state(system, random);
  expect_derivatives(at, state, random);

  const Eigen::Vector3d y = random_vector(3, random);
  const Eigen::VectorXd forces = at.forces(state, y);
  for (const int each : {body, point, other})
    expect_same(at.constraint.on_body(each, state, y), forces.segment<3>(position_of(system, each)), 1e-14);
  expect_same(at.constraint.force(y), y, 1e-15);
}

}  // namespace nurbeam::testing::point_on_body_test
