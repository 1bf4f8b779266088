#include "fem/constraints/body_on_guide.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::body_on_guide_test {

constexpr int body = 0;

// On a guide of two segments, at that part of it.
BeamSystem on_guide(int dimension, double part) {
  ModelBuilder builder(dimension);
  const int guide =
      builder.add_guide(ReferenceCurve({bent_cubic(dimension), going_on(dimension)}, dimension));
  add_sliding(builder, guide, part * builder.beam(guide).curve.length());
  return BeamSystem(builder.build());
}

template <int D>
void check_value(double part) {
  std::mt19937 random(1);
  const BeamSystem system = on_guide(D, part);
  const ReferenceCurve& guide = system.model().beams[0].curve;
  const auto tie = the_constraint<D, BodyOnGuide<D>>(system);
  State state = drawn_state(system);
  EXPECT_LT(tie.value(state).norm(), 1e-14);
  const int place = place_of(system, body);
  const double s = state.q[place] + (part < 1 ? 0.05 : -0.05);
  const Eigen::Matrix<double, D, 1> apart = random_vector(D, random);
  state.q[place] = s;
  state.q.segment<D>(position_of(system, body)) = guide.position(s).head<D>() - apart;
  expect_same(tie.value(state), apart, 1e-13);

  const Eigen::VectorXd y = random_vector(D, random), forces = tie.forces(state, y);
  expect_same(forces.segment<D>(position_of(system, body)), y, 1e-14);
  EXPECT_NEAR(forces[place], -y.dot(guide.tangent(s).head<D>()), 1e-13);
}
TEST(BodyOnGuide, IsOpenByTheWayFromTheBodyToItsPlaceAndPushesAgainstTheCurve) {
  for (const double part : {0.0, 0.3, 0.8, 1.0}) {
    check_value<2>(part);
    check_value<3>(part);
  }
}

template <int D>
void check_derivatives(double part) {
  std::mt19937 random(2);
  const BeamSystem system = on_guide(D, part);
  expect_derivatives(the_constraint<D, BodyOnGuide<D>>(system), disturbed_state(system, random), random);
}
TEST(BodyOnGuide, HasTheDerivativesOfItsValueBeyondItsEndsToo) {
  for (const double part : {0.0, 0.3, 0.8, 1.0}) {
    check_derivatives<2>(part);
    check_derivatives<3>(part);
  }
}

}  // namespace nurbeam::testing::body_on_guide_test
