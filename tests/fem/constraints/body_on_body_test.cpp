#include "fem/constraints/body_on_body.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::body_on_body_test {

const Eigen::Vector3d drawn(1, 2, 0), of_carrier(1.3, 1.8, 0);

// The third of three bodies is carried by the second, and drawn elsewhere.
template <int D>
void check_carried_body() {
  std::mt19937 random(1);
  ModelBuilder builder(D);
  const int free_body = builder.add_body("free", 1, {0, 0, 0});
  const int carrier = builder.add_body("carrier", 2, of_carrier);
  const int ring = builder.add_body("ring", 1, drawn);
  builder.add(Constraint(CarriedBody{.body = ring, .carrier = carrier}));
  const BeamSystem system(builder.build());
  const auto carries = the_constraint<D, BodyOnBody<D>>(system);
  State state = disturbed_state(system, random);
  for (const double load : {0.0, 0.4, 1.0}) {
    state.load = load;
    const Eigen::Matrix<double, D, 1> apart =
        state.q.segment<D>(position_of(system, ring)) - state.q.segment<D>(position_of(system, carrier));
    expect_same(carries.value(state), apart - (1 - load) * (drawn - of_carrier).head<D>(), 1e-14);
  }
  expect_derivatives(carries, state, random);

  const Eigen::Matrix<double, D, 1> y = random_vector(D, random);
  const Eigen::VectorXd forces = carries.forces(state, y);
  for (const int body : {free_body, carrier, ring})
    expect_same(carries.constraint.on_body(body, state, y), forces.segment<D>(position_of(system, body)),
                1e-14);
  expect_same(carries.constraint.on_body(ring, state, y), -y, 1e-14);
  expect_same(carries.constraint.on_body(carrier, state, y), y, 1e-14);
}
TEST(BodyOnBody, KeepsABodyWhereItsCarrierIs) {
  check_carried_body<2>();
  check_carried_body<3>();
}

}  // namespace nurbeam::testing::body_on_body_test
