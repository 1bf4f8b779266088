#include "fem/constraints/held_axis.h"

#include <cmath>

#include "fem/constraints/joined_points.h"
#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::held_axis_test {

const Eigen::Vector3d axis(0.2, 1, 0.5);

// A beam whose end is held by an axis in space, and one that is joined to it there by a hinge with one.
BeamSystem hinged(bool to_another) {
  ModelBuilder builder(3);
  const int a = add_twisted_beam(builder);
  const double L = builder.beam(a).curve.length();
  if (!to_another) {
    builder.add(Support{.beam = a, .s = L, .axis = axis});
    return BeamSystem(builder.build());
  }
  const int b = builder.add_beam(ReferenceCurve({going_on(3)}, 3), with_sections(), {4});
  builder.add(BeamJoint{.beam_a = a, .s_a = L, .beam_b = b, .s_b = 0, .axis = axis});
  return BeamSystem(builder.build());
}

// The drawing with the last beam turned as a whole.
State turned(const BeamSystem& system, double angle, const Eigen::Vector3d& about) {
  State state = drawn_state(system);
  const Eigen::AngleAxisd turn(angle, about.normalized());
  const State moved = rigidly_moved(system, state, {turn.toRotationMatrix()});
  const int last = static_cast<int>(system.model().beams.size()) - 1;
  for (const int i : coordinates_of_beam(system, last)) state.q[i] = moved.q[i];
  return state;
}

TEST(HeldAxis, LetsTheSectionTurnAboutItAlone) {
  for (const bool to_another : {false, true}) {
    const BeamSystem system = hinged(to_another);
    const auto hinge = the_constraint<3, HeldAxis>(system);
    for (const double angle : {-2.0, -0.4, 0.7, 2.5})
      EXPECT_LT(hinge.value(turned(system, angle, axis)).norm(), 1e-12) << angle;
    const Eigen::Vector3d across = axis.unitOrthogonal();
    EXPECT_NEAR(hinge.value(turned(system, 0.4, across)).norm(), std::sin(0.4), 1e-12);
    EXPECT_NEAR(hinge.value(turned(system, 0.4, axis.cross(across))).norm(), std::sin(0.4), 1e-12);
  }
}

TEST(HeldAxis, BetweenTwoBeamsGoesWithBoth) {
  const BeamSystem system = hinged(true);
  std::mt19937 random(1);
  const State state = disturbed_state(system, random),
              moved = rigidly_moved(system, state, random_rigid_motion(3, random));
  const auto hinge = the_constraint<3, HeldAxis>(system);
  EXPECT_GT(hinge.value(state).norm(), 1e-3);
  expect_same(hinge.value(moved), hinge.value(state), 1e-12);
}

TEST(HeldAxis, HasTheDerivativesOfItsValue) {
  for (const bool to_another : {false, true}) {
    std::mt19937 random(2);
    const BeamSystem system = hinged(to_another);
    expect_derivatives(the_constraint<3, HeldAxis>(system), disturbed_state(system, random, 0.1), random);
  }
}

// On the beam of a support; of a joint on its first beam, and as much back on the second.
TEST(HeldAxis, IsACoupleAcrossTheAxis) {
  for (const bool to_another : {false, true}) {
    std::mt19937 random(3);
    const BeamSystem system = hinged(to_another);
    const auto hinge = the_constraint<3, HeldAxis>(system);
    const State state = disturbed_state(system, random, 0.1);
    const Eigen::Vector2d y = random_vector(2, random);
    const Eigen::VectorXd forces = hinge.forces(state, y);
    const Resultant on_first = resultant(system, state, forces, coordinates_of_beam(system, 0));
    EXPECT_LT(on_first.force.norm(), 1e-10);
    EXPECT_GT(on_first.moment.norm(), 0.1);
    expect_same(on_first.moment, hinge.constraint.couple(hinge.in.beams(), state, y));
    if (to_another)
      expect_opposite(on_first, resultant(system, state, forces, coordinates_of_beam(system, 1)));
    const Eigen::Vector3d at_rest = hinge.constraint.couple(hinge.in.beams(), drawn_state(system), y);
    EXPECT_NEAR(at_rest.dot(axis), 0, 1e-12);
  }
}

}  // namespace nurbeam::testing::held_axis_test
