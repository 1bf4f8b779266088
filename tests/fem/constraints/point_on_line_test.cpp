#include "fem/constraints/point_on_line.h"

#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"
#include "tests/fem/rigid_bodies.h"

namespace nurbeam::testing::point_on_line_test {

const Eigen::Vector3d along(1, 2, 0.5);

BeamSystem sliding(bool on_body) {
  ModelBuilder builder(3);
  const int body = add_tumbling_body(builder), carrier = add_tumbling_body(builder, "carrier", {1, 0, 0});
  const Grip to = on_body ? Grip::on_body(carrier) : Grip::at_point(tumbling_at);
  builder.add(Constraint(BodyJoint{
      .name = "", .point = body, .to = to, .arm = tumbling_at - Eigen::Vector3d(1, 0, 0), .slide = along}));
  return BeamSystem(builder.build());
}

TEST(PointOnLine, LeavesTheWayAlongTheLineFree) {
  const BeamSystem system = sliding(true);
  const auto line = the_constraint<3, PointOnLine>(system);
  State state = drawn_state(system);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.2, Eigen::Vector3d(0.1, 1, -1).normalized()));
  const Eigen::Vector3d centre(2, 3, 4), arm = tumbling_at - Eigen::Vector3d(1, 0, 0);
  put(system, state, 1, centre, turn);
  for (const double way : {-1.0, 0.0, 2.0}) {
    put(system, state, 0, centre + turn * (arm + way * along), Eigen::Quaterniond::Identity());
    EXPECT_LT(line.value(state).norm(), 1e-14);
  }
}

TEST(PointOnLine, HasTheDerivativesOfItsValueAndTellsItsForces) {
  std::mt19937 random(3);
  for (const bool on_body : {true, false}) {
    const BeamSystem system = sliding(on_body);
    const auto line = the_constraint<3, PointOnLine>(system);
    const State state = general_state(system, random);
    expect_derivatives(line, state, random);
    const Eigen::Vector2d y = random_vector(2, random);
    for (const int body : {0, 1})
      expect_same(line.constraint.on_body(body, state, y),
                  line.forces(state, y).segment<3>(position_of(system, body)), 1e-13);
  }
}

}  // namespace nurbeam::testing::point_on_line_test
