#include "fem/constraints/body_on_point.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::body_on_point_test {

constexpr int body = 0;

// A body as a point at that part of a beam, whose elements there stay, or are beside a body that is a node.
BeamSystem on_beam(int dimension, double part, bool beside_node = false) {
  ModelBuilder builder(dimension);
  const int beam = add_bent_beam(builder, dimension);
  const double L = builder.beam(beam).curve.length();
  add_sliding(builder, beam, part * L, {.as_point = true});
  if (beside_node) add_sliding(builder, beam, (part + 0.06) * L);
  return BeamSystem(builder.build());
}

template <int D>
void check_value(double part, double shift, bool beside_node) {
  std::mt19937 random(1);
  const BeamSystem system = on_beam(D, part, beside_node);
  const AffineMap map = random_map(D, random);
  const State state = mapped_drawing(system, map, shift);
  const ReferenceCurve& curve = system.model().beams[0].curve;
  const double s = state.q[place_of(system, body)];
  const Eigen::Vector3d open = map.F * (curve.position(s) - curve.position(s - shift));
  expect_same(the_constraint<D, BodyOnPoint<D>>(system).value(state), open.head<D>(), 1e-12);
}

template <int D>
void check_values() {
  for (const double part : {0.0, 0.43, 0.625}) check_value<D>(part, 0.03, false);
  check_value<D>(1, -0.03, false);
  check_value<D>(0.5, 0.01, true);
}
TEST(BodyOnPoint, IsOpenByTheWayFromTheBodyToThePlace) {
  check_values<2>();
  check_values<3>();
}

template <int D>
void check_derivatives() {
  std::mt19937 random(2);
  for (const bool beside_node : {false, true})
    for (const double part : {0.0, 0.43, 0.94}) {
      const BeamSystem system = on_beam(D, part, beside_node);
      expect_derivatives(the_constraint<D, BodyOnPoint<D>>(system), disturbed_state(system, random), random);
    }
}
TEST(BodyOnPoint, HasTheDerivativesOfItsValue) {
  check_derivatives<2>();
  check_derivatives<3>();
}

template <int D>
void check_forces(double part, bool beside_node) {
  std::mt19937 random(3);
  const BeamSystem system = on_beam(D, part, beside_node);
  const AffineMap map = random_map(D, random);
  const State state = mapped_drawing(system, map);
  const auto tie = the_constraint<D, BodyOnPoint<D>>(system);
  const Eigen::Matrix<double, D, 1> y = random_vector(D, random);
  const Eigen::VectorXd forces = tie.forces(state, y);
  const Resultant on_body = resultant(system, state, forces, coordinates_of_body(system, body)),
                  on_axis = resultant(system, state, forces, coordinates_of_beam(system, 0));
  expect_same(on_body.force, widened<D>(y));
  expect_opposite(on_body, on_axis);
  const int place = place_of(system, body);
  const Eigen::Vector3d slope = map.F * system.model().beams[0].curve.tangent(state.q[place]);
  EXPECT_NEAR(forces[place], -widened<D>(y).dot(slope), 1e-12);

  const PointAction action = tie.constraint.action(tie.in.beams(), state, y);
  const Eigen::Vector3d there = map(system.model().beams[0].curve.position(action.s));
  expect_same(on_axis.force, action.force);
  expect_same(on_axis.moment, there.cross(action.force) + action.couple);
}
TEST(BodyOnPoint, GivesTheBodyWhatTheBeamLoses) {
  for (const double part : {0.0, 0.43, 1.0}) {
    check_forces<2>(part, false);
    check_forces<3>(part, false);
  }
  check_forces<2>(0.5, true);
  check_forces<3>(0.5, true);
}

}  // namespace nurbeam::testing::body_on_point_test
