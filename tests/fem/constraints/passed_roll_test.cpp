#include "fem/constraints/passed_roll.h"

#include <cmath>

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"
#include "tests/fem/section_witness.h"

namespace nurbeam::testing::passed_roll_test {

constexpr int body = 0;

// A body that bends a beam with torsion by an angle.
BeamSystem with_kink() {
  ModelBuilder builder(3);
  const int beam = add_twisted_beam(builder);
  add_sliding(builder, beam, 0.4 * builder.beam(beam).curve.length(), {.kinked = true});
  return BeamSystem(builder.build());
}

// The drawn section at the body, columns.
Eigen::Matrix3d drawn_section(const BeamSystem& system) {
  const DrawnSection section = system.model().beams[0].curve.section(node_of(system, body).s);
  Eigen::Matrix3d triad;
  triad << section.d1, section.d2, section.t;
  return triad;
}

// The drawing with that section behind the body.
State with_section_behind(const BeamSystem& system, const Eigen::Matrix3d& section) {
  State state = drawn_state(system);
  const MeshNode& node = node_of(system, body);
  state.q.segment<3>(node.slope_right) = 1.1 * section.col(2);
  state.q[node.angle_right] = angle_of(section, drawn_section(system));
  return state;
}

TEST(PassedRoll, IsTwiceTheSineOfTheTurnAboutTheTangent) {
  const BeamSystem system = with_kink();
  const auto passed = the_constraint<3, PassedRoll>(system);
  const Eigen::Matrix3d before = drawn_section(system);
  EXPECT_NEAR(passed.value(drawn_state(system))[0], 0, 1e-14);
  for (const double turn : {-0.8, 0.3, 1.2}) {
    const Eigen::Matrix3d behind = Eigen::AngleAxisd(turn, before.col(2)).toRotationMatrix() * before;
    EXPECT_NEAR(passed.value(with_section_behind(system, behind))[0], 2 * std::sin(turn), 1e-12);
  }
}

TEST(PassedRoll, LetsTheBeamBendAtTheBody) {
  const BeamSystem system = with_kink();
  const auto passed = the_constraint<3, PassedRoll>(system);
  const Eigen::Matrix3d before = drawn_section(system);
  for (const double way : {0.0, 0.7, 2.0}) {
    const Eigen::Vector3d across = std::cos(way) * before.col(0) + std::sin(way) * before.col(1);
    const Eigen::Matrix3d behind = Eigen::AngleAxisd(0.8, across).toRotationMatrix() * before;
    EXPECT_NEAR(passed.value(with_section_behind(system, behind))[0], 0, 1e-12);
  }
}

TEST(PassedRoll, HasTheDerivativesOfItsValueAndKnowsNoRigidMotion) {
  const BeamSystem system = with_kink();
  std::mt19937 random(1);
  const auto passed = the_constraint<3, PassedRoll>(system);
  const State state = disturbed_state(system, random, 0.1);
  expect_derivatives(passed, state, random);
  const State moved = rigidly_moved(system, state, random_rigid_motion(3, random));
  EXPECT_GT(std::abs(passed.value(state)[0]), 1e-3);
  EXPECT_NEAR(passed.value(moved)[0], passed.value(state)[0], 1e-12);

  const Eigen::VectorXd forces = passed.forces(state, Eigen::VectorXd::Constant(1, 1.3));
  const MeshNode& node = node_of(system, body);
  const int index = static_cast<int>(&node - system.mesh().nodes[0].data());
  const Resultant before = resultant(system, state, forces, coordinates_before_node(system, 0, index));
  EXPECT_GT(before.moment.norm(), 0.1);
  expect_opposite(resultant(system, state, forces), {});
}

}  // namespace nurbeam::testing::passed_roll_test
