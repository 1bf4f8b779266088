#include "fem/constraints/joined_sections.h"

#include <cmath>

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::joined_sections_test {

// Of a rigid joint of two beams, or of a rigid corner of one.
BeamSystem joined() {
  ModelBuilder builder(3);
  const int a = add_twisted_beam(builder),
            b = builder.add_beam(ReferenceCurve({going_on(3)}, 3), with_sections(), {4});
  builder.join(a, 0.5 * builder.beam(a).curve.length(), b, 0, true);
  return BeamSystem(builder.build());
}

BeamSystem with_corner() {
  ModelBuilder builder(3);
  const int beam = builder.add_beam(ReferenceCurve({bent_cubic(3), going_on(3)}, 3), with_sections(), {8});
  BeamModel model = builder.build();
  for (HomeNode& node : model.beams[beam].home)
    if (node.s == model.beams[beam].curve.breaks()[1]) node.kind = NodeKind::rigid;
  return BeamSystem(model);
}

int corner_of(const BeamSystem& system) {
  const std::vector<MeshNode>& nodes = system.mesh().nodes[0];
  int i = 0;
  while (nodes[static_cast<std::size_t>(i)].slope_left == nodes[static_cast<std::size_t>(i)].slope_right) ++i;
  return i;
}

// Coordinates of the first of the two.
std::vector<int> first_part(const BeamSystem& system) {
  return system.model().beams.size() == 2 ? coordinates_of_beam(system, 0)
                                          : coordinates_before_node(system, 0, corner_of(system));
}

TEST(JoinedSections, AreOpenByTheSineOfTheTurnBetweenBoth) {
  for (const BeamSystem& system : {joined(), with_corner()}) {
    const auto joint = the_constraint<3, JoinedSections>(system);
    const State drawn = drawn_state(system);
    EXPECT_LT(joint.value(drawn).norm(), 1e-13);
    const Eigen::Vector3d u = Eigen::Vector3d(0.5, -1, 0.3).normalized();
    const double angle = 0.6;
    const State all = rigidly_moved(system, drawn, {Eigen::AngleAxisd(angle, u).toRotationMatrix()});
    EXPECT_LT(joint.value(all).norm(), 1e-12);
    // The second one alone is turned.
    State second = all;
    for (const int i : first_part(system)) second.q[i] = drawn.q[i];
    expect_same(joint.value(second), std::sin(angle) * u, 1e-12);
  }
}

TEST(JoinedSections, HaveTheDerivativesOfTheirValueAndTurnWithBoth) {
  for (const BeamSystem& system : {joined(), with_corner()}) {
    std::mt19937 random(2);
    const auto joint = the_constraint<3, JoinedSections>(system);
    const State state = disturbed_state(system, random, 0.1);
    expect_derivatives(joint, state, random);
    const AffineMap motion = random_rigid_motion(3, random);
    expect_same(joint.value(rigidly_moved(system, state, motion)), motion.F * joint.value(state), 1e-12);
  }
}

TEST(JoinedSections, AreOppositeMomentsWhichAreTheMultipliers) {
  for (const BeamSystem& system : {joined(), with_corner()}) {
    std::mt19937 random(3);
    const auto joint = the_constraint<3, JoinedSections>(system);
    const State state = disturbed_state(system, random, 0.1), drawn = drawn_state(system);
    const Eigen::Vector3d y = random_vector(3, random);
    const Resultant first = resultant(system, state, joint.forces(state, y), first_part(system));
    EXPECT_LT(first.force.norm(), 1e-9);
    expect_same(first.moment, joint.constraint.couple(joint.in.beams(), state, y));
    // y . g turns with both where they are not as drawn.
    const Eigen::Vector3d g = joint.value(state);
    expect_same(resultant(system, state, joint.forces(state, y)).moment, y.cross(g));
    const Resultant at_rest = resultant(system, drawn, joint.forces(drawn, y), first_part(system));
    EXPECT_NEAR(at_rest.moment.norm(), y.norm(), 1e-9);
    expect_opposite(resultant(system, drawn, joint.forces(drawn, y)), {});
  }
}

}  // namespace nurbeam::testing::joined_sections_test
