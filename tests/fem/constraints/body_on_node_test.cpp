#include "fem/constraints/body_on_node.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::body_on_node_test {

constexpr int body = 0;

// A body with friction, which has coordinates of its own beside those of its node.
template <int D>
BeamSystem on_beam() {
  ModelBuilder builder(D);
  const int beam = add_bent_beam(builder, D);
  add_sliding(builder, beam, 0.4 * builder.beam(beam).curve.length(),
              {.friction = Friction{.coefficient = 0.2}});
  return BeamSystem(builder.build());
}

template <int D>
void check_value() {
  const BeamSystem system = on_beam<D>();
  std::mt19937 random(1);
  State state = mapped_drawing(system, random_map(D, random), 0.02);
  const auto tie = the_constraint<D, BodyOnNode<D>>(system);
  EXPECT_EQ(tie.constraint.body(), position_of(system, body));
  state.q.segment<D>(position_of(system, body)) = state.q.segment<D>(node_of(system, body).r);
  EXPECT_EQ(tie.value(state).norm(), 0);
  const Eigen::Matrix<double, D, 1> apart = random_vector(D, random);
  state.q.segment<D>(position_of(system, body)) -= apart;
  expect_same(tie.value(state), apart, 1e-14);
}
TEST(BodyOnNode, IsOpenByTheWayFromTheBodyToItsNode) {
  check_value<2>();
  check_value<3>();
}

template <int D>
void check_derivatives() {
  const BeamSystem system = on_beam<D>();
  std::mt19937 random(2);
  const auto tie = the_constraint<D, BodyOnNode<D>>(system);
  State state = disturbed_state(system, random);
  expect_derivatives(tie, state, random);

  state.q.segment<D>(position_of(system, body)) = state.q.segment<D>(node_of(system, body).r);
  const Eigen::Matrix<double, D, 1> y = random_vector(D, random);
  const Eigen::VectorXd forces = tie.forces(state, y);
  const Resultant on_body = resultant(system, state, forces, coordinates_of_body(system, body));
  expect_same(on_body.force, widened<D>(y));
  expect_opposite(on_body, resultant(system, state, forces, coordinates_of_beam(system, 0)));
}
TEST(BodyOnNode, HasTheDerivativesOfItsValueAndGivesTheBodyWhatTheNodeLoses) {
  check_derivatives<2>();
  check_derivatives<3>();
}

}  // namespace nurbeam::testing::body_on_node_test
