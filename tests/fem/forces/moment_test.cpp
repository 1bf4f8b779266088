#include "fem/forces/moment.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::moment_test {

const TimeTable ramp{{0, 0.5}, {1, 2}};
Eigen::Vector3d value(int dimension) {
  return dimension == 3 ? Eigen::Vector3d(0.4, 1, -0.6) : Eigen::Vector3d(0, 0, 1.3);
}

BeamSystem loaded(int dimension, double part, bool follower, bool beside_body = false) {
  ModelBuilder builder(dimension);
  const int beam = add_bent_beam(builder, dimension);
  const double s = part * builder.beam(beam).curve.length();
  if (beside_body) add_sliding(builder, beam, s + 0.05);
  builder.add(Moment{{.beam = beam, .s = s, .value = value(dimension), .follower = follower, .time = ramp}});
  return BeamSystem(builder.build());
}

// Without torsion its part along the beam does nothing.
template <int D>
void check_moment(double part, bool follower, bool beside_body) {
  std::mt19937 random(1);
  const BeamSystem system = loaded(D, part, follower, beside_body);
  const auto moment = the_force<D, Moment>(system);
  const AffineMap map = random_map(D, random);
  State state = mapped_drawing(system, map);
  state.t = 0.2;
  state.load = 0.6;
  const ReferenceCurve& curve = system.model().beams[0].curve;
  const Eigen::Vector3d drawn = curve.tangent(part * curve.length()), slope = map.F * drawn,
                        t = slope.normalized();
  Eigen::Vector3d m = 0.6 * 0.8 * value(D);
  if (follower) m = Eigen::Quaterniond::FromTwoVectors(drawn, slope).toRotationMatrix() * m;
  const Resultant on_beam = resultant(system, state, -moment.dynamics(state));
  EXPECT_LT(on_beam.force.norm(), 1e-9);
  expect_same(on_beam.moment, m - t.dot(m) * t);
  if (D == 2) expect_actions(moment, system, state, 0);
}
TEST(Moment, TurnsTheSlopeAtItsPlaceDeadOrWithTheTangent) {
  for (const bool follower : {false, true}) {
    for (const double part : {0.0, 0.43, 1.0}) {
      check_moment<2>(part, follower, false);
      check_moment<3>(part, follower, false);
    }
    check_moment<2>(0.5, follower, true);
    check_moment<3>(0.5, follower, true);
  }
}

template <int D>
void check_derivatives(double part, bool follower, bool beside_body) {
  std::mt19937 random(2);
  const BeamSystem system = loaded(D, part, follower, beside_body);
  const auto moment = the_force<D, Moment>(system);
  State state = disturbed_state(system, random);
  state.t = 0.3;
  expect_tangent(moment, state, random);
  expect_work_of_power(moment, state);
}
TEST(Moment, HasTheDerivativesOfItsForceAndDoesItsWork) {
  for (const bool follower : {false, true}) {
    for (const double part : {0.0, 0.43, 1.0}) {
      check_derivatives<2>(part, follower, false);
      check_derivatives<3>(part, follower, false);
    }
    check_derivatives<2>(0.5, follower, true);
    check_derivatives<3>(0.5, follower, true);
  }
}

}  // namespace nurbeam::testing::moment_test
