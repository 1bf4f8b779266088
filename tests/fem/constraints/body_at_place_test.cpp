#include "fem/constraints/body_at_place.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"
#include "tests/fem/rigid_bodies.h"

namespace nurbeam::testing::body_at_place_test {

TEST(BodyAtPlace, IsTheWayFromTheNodeOfTheBeam) {
  std::mt19937 random(4);
  ModelBuilder builder(3);
  const int beam = add_bent_beam(builder, 3);
  const double s = builder.beam(beam).curve.length() / 3;
  const int body = add_tumbling_body(builder, "body", builder.beam(beam).curve.position(s));
  builder.add(Constraint(BodyJoint{.name = "", .point = body, .to = Grip::on_beam(beam, s)}));
  const BeamSystem system(builder.build());
  const auto at = the_constraint<3, BodyAtPlace>(system);
  EXPECT_LT(at.value(drawn_state(system)).norm(), 1e-12);
  const State state = general_state(system, random);
  expect_derivatives(at, state, random);
  const Eigen::Vector3d y = random_vector(3, random);
  expect_same(at.constraint.on_body(body, state, y),
              at.forces(state, y).segment<3>(position_of(system, body)));
}

}  // namespace nurbeam::testing::body_at_place_test
