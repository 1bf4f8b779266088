#include "fem/forces/line_torque.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::line_torque_test {

constexpr double value = 0.7;
const TimeTable ramp{{0, 0.5}, {1, 2}};

BeamSystem loaded(bool with_body) {
  ModelBuilder builder(3);
  const int beam = add_twisted_beam(builder);
  if (with_body) add_sliding(builder, beam, 0.7);
  builder.add(LineTorque{beam, value, ramp});
  return BeamSystem(builder.build());
}

// Along the tangents of a beam that moves as a rigid body these add up to its chord.
TEST(LineTorque, AddsUpToItsValueTimesTheChord) {
  for (const bool with_body : {false, true}) {
    std::mt19937 random(1);
    const BeamSystem system = loaded(with_body);
    const auto torque = the_force<3, LineTorque>(system);
    const AffineMap motion = random_rigid_motion(3, random);
    State state = rigidly_moved(system, drawn_state(system), motion);
    state.t = 0.2;
    state.load = 0.6;
    const ReferenceCurve& curve = system.model().beams[0].curve;
    const Eigen::Vector3d chord = motion.F * (curve.position(curve.length()) - curve.position(0));
    const Resultant on_beam = resultant(system, state, -torque.dynamics(state));
    EXPECT_LT(on_beam.force.norm(), 1e-8);
    expect_same(on_beam.moment, 0.6 * 0.8 * value * chord, 1e-6);
  }
}

TEST(LineTorque, HasTheDerivativesOfItsForceAndDoesItsWork) {
  for (const bool with_body : {false, true}) {
    std::mt19937 random(2);
    const BeamSystem system = loaded(with_body);
    const auto torque = the_force<3, LineTorque>(system);
    State state = disturbed_state(system, random);
    state.t = 0.3;
    expect_tangent(torque, state, random);
    expect_work_of_power(torque, state);
  }
}

}  // namespace nurbeam::testing::line_torque_test
