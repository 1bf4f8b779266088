#include "fem/constraints/held_roll.h"

#include <cmath>

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::held_roll_test {

// Held at that part of its length by a clamp or a fork.
BeamSystem held(bool by_fork, double part) {
  ModelBuilder builder(3);
  const int beam = add_twisted_beam(builder);
  const double s = part * builder.beam(beam).curve.length();
  by_fork ? builder.fork(beam, s) : builder.clamp(beam, s);
  return BeamSystem(builder.build());
}

DrawnSection section_of(const BeamSystem& system, double part) {
  const ReferenceCurve& curve = system.model().beams[0].curve;
  return curve.section(part * curve.length(), part == 1);
}

State turned(const BeamSystem& system, double angle, const Eigen::Vector3d& about) {
  return rigidly_moved(system, drawn_state(system), {Eigen::AngleAxisd(angle, about).toRotationMatrix()});
}

TEST(ClampedRoll, IsTheAngleAboutTheTangent) {
  for (const double part : {0.0, 0.5, 1.0}) {
    const BeamSystem system = held(false, part);
    const auto roll = the_constraint<3, ClampedRoll>(system);
    const Eigen::Vector3d t = section_of(system, part).t;
    EXPECT_NEAR(roll.value(turned(system, 0.7, t))[0], 0.7, 1e-12);
    EXPECT_NEAR(roll.value(turned(system, 0.7, t.unitOrthogonal()))[0], 0, 1e-12);
  }
}

// Where the direction of the slope is held as well.
TEST(ClampedRoll, IsACoupleAlongTheTangent) {
  for (const double part : {0.0, 0.5, 1.0}) {
    const BeamSystem system = held(false, part);
    const auto roll = the_constraint<3, ClampedRoll>(system);
    const State state = turned(system, 0.3, section_of(system, part).t);
    const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, 1.4);
    const Resultant on_beam = resultant(system, state, roll.forces(state, y));
    EXPECT_LT(on_beam.force.norm(), 1e-10);
    expect_same(on_beam.moment, -1.4 * section_of(system, part).t);
    expect_same(on_beam.moment, roll.constraint.couple(roll.in.beams(), state, y));
  }
}

TEST(ForkedRoll, LetsTheSectionBendBothWays) {
  for (const double part : {0.0, 0.5, 1.0}) {
    const BeamSystem system = held(true, part);
    const auto roll = the_constraint<3, ForkedRoll>(system);
    const DrawnSection drawn = section_of(system, part);
    EXPECT_NEAR(roll.value(turned(system, 0.7, drawn.t))[0], -std::sin(0.7), 1e-12);
    EXPECT_NEAR(roll.value(turned(system, 0.7, drawn.d1))[0], 0, 1e-12);
    EXPECT_NEAR(roll.value(turned(system, 0.7, drawn.d2))[0], 0, 1e-12);
  }
}

TEST(ForkedRoll, IsACoupleOnTheBeam) {
  for (const double part : {0.0, 0.5, 1.0}) {
    std::mt19937 random(1);
    const BeamSystem system = held(true, part);
    const auto roll = the_constraint<3, ForkedRoll>(system);
    const State state = disturbed_state(system, random, 0.1);
    const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, 1.4);
    const Resultant on_beam = resultant(system, state, roll.forces(state, y));
    EXPECT_LT(on_beam.force.norm(), 1e-10);
    EXPECT_GT(on_beam.moment.norm(), 0.5);
    expect_same(on_beam.moment, roll.constraint.couple(roll.in.beams(), state, y));
  }
}

TEST(HeldRoll, HasTheDerivativesOfItsValue) {
  for (const double part : {0.0, 0.5, 1.0}) {
    std::mt19937 random(2);
    const BeamSystem clamped = held(false, part), forked = held(true, part);
    expect_derivatives(the_constraint<3, ClampedRoll>(clamped), disturbed_state(clamped, random), random);
    expect_derivatives(the_constraint<3, ForkedRoll>(forked), disturbed_state(forked, random, 0.1), random);
  }
}

}  // namespace nurbeam::testing::held_roll_test
