#include "fem/constraints/body_on_section.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::body_on_section_test {

constexpr int body = 0;
const Eigen::Vector2d offset(0.1, -0.2);

enum class Carrier { node, fixed_element, beside_node };

BeamSystem on_beam(Carrier carrier) {
  ModelBuilder builder(3);
  const int beam = add_twisted_beam(builder);
  const double L = builder.beam(beam).curve.length();
  add_sliding(builder, beam, 0.4 * L, {.as_point = carrier != Carrier::node, .offset = offset});
  if (carrier == Carrier::beside_node) add_sliding(builder, beam, 0.46 * L);
  return BeamSystem(builder.build());
}

// Calls check(system, constraint) for each that carries the body.
template <class Check>
void for_each_carrier(const Check& check) {
  const BeamSystem node = on_beam(Carrier::node);
  check(node, the_constraint<3, BodyOnSection<FollowedNode>>(node));
  for (const Carrier carrier : {Carrier::fixed_element, Carrier::beside_node}) {
    const BeamSystem point = on_beam(carrier);
    check(point, the_constraint<3, BodyOnSection<FollowedPoint>>(point));
  }
}

// Where the body is: beside the axis, along the section's own axes, in every rigid motion.
TEST(BodyOnSection, IsClosedWhereTheSectionCarriesTheBody) {
  for_each_carrier([](const BeamSystem& system, const auto& tie) {
    std::mt19937 random(1);
    const ReferenceCurve& curve = system.model().beams[0].curve;
    State state = drawn_state(system);
    const DrawnSection section = curve.section(state.q[place_of(system, body)]);
    const Eigen::Vector3d there =
        curve.position(state.q[place_of(system, body)]) + offset[0] * section.d1 + offset[1] * section.d2;
    expect_same(state.q.segment<3>(position_of(system, body)), there, 1e-13);
    const AffineMap motion = random_rigid_motion(3, random);
    state = rigidly_moved(system, state, motion);
    EXPECT_LT(tie.value(state).norm(), 1e-12);
    const Eigen::Vector3d apart = random_vector(3, random);
    state.q.segment<3>(position_of(system, body)) -= apart;
    expect_same(tie.value(state), apart, 1e-12);
  });
}

// A section that rolls by an angle takes the body with it round the axis.
TEST(BodyOnSection, OfANodeRollsWithItsAngle) {
  const BeamSystem system = on_beam(Carrier::node);
  const auto tie = the_constraint<3, BodyOnSection<FollowedNode>>(system);
  const DrawnSection section = system.model().beams[0].curve.section(node_of(system, body).s);
  State state = drawn_state(system);
  const double roll = 0.6;
  state.q[node_of(system, body).angle_right] += roll;
  const Eigen::Vector3d arm = offset[0] * section.d1 + offset[1] * section.d2;
  expect_same(tie.value(state), Eigen::AngleAxisd(roll, section.t) * arm - arm, 1e-13);
}

TEST(BodyOnSection, HasTheDerivativesOfItsValue) {
  for_each_carrier([](const BeamSystem& system, const auto& tie) {
    std::mt19937 random(2);
    const State state = disturbed_state(system, random);
    expect_derivatives(tie, state, random);

    Eigen::Matrix<double, ConstraintTerms<3>::size, 1> rates;
    rates.setZero();
    for (std::size_t k = 0; k < tie.constraint.dofs().size(); ++k)
      if (const int dof = tie.constraint.dofs()[k]; dof >= 0) rates[static_cast<int>(k)] = state.v[dof];
    expect_same(tie.constraint.curvature(tie.in.beams(), state, rates), tie.curvature(state), 1e-11);
  });
}

TEST(BodyOnSection, GivesTheBodyWhatTheBeamLosesWithItsMoment) {
  for_each_carrier([](const BeamSystem& system, const auto& tie) {
    std::mt19937 random(3);
    State state = disturbed_state(system, random);
    state.q.segment<3>(position_of(system, body)) += tie.value(state);
    const Eigen::Vector3d y = random_vector(3, random);
    const Eigen::VectorXd forces = tie.forces(state, y);
    const Resultant on_body = resultant(system, state, forces, coordinates_of_body(system, body));
    expect_same(on_body.force, y);
    expect_opposite(on_body, resultant(system, state, forces, coordinates_of_beam(system, 0)));
  });
}

TEST(BodyOnSection, OfAPointActsThereWithTheCoupleOfItsArm) {
  const BeamSystem system = on_beam(Carrier::beside_node);
  const auto tie = the_constraint<3, BodyOnSection<FollowedPoint>>(system);
  std::mt19937 random(4);
  const State state = rigidly_moved(system, drawn_state(system), random_rigid_motion(3, random));
  const Eigen::Vector3d y = random_vector(3, random);
  const PointAction action = tie.constraint.action(tie.in.beams(), state, y).value();
  const MeshElement<3>& e = tie.in.elements()[static_cast<std::size_t>(action.element)];
  const Eigen::Vector3d there = material_point(e, state.q, state.v, action.s).r,
                        at_body = state.q.segment<3>(position_of(system, body));
  expect_same(action.force, -y);
  expect_same(action.couple, (at_body - there).cross(action.force));
}

}  // namespace nurbeam::testing::body_on_section_test
