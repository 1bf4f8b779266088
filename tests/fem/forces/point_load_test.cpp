#include "fem/forces/point_load.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::point_load_test {

const TimeTable ramp{{0, 0.5}, {1, 2}};
Eigen::Vector3d value(int dimension) { return {1, -2, dimension == 3 ? 0.7 : 0}; }

// At a part of a beam whose elements stay there, or are beside a body at that part.
BeamSystem loaded(int dimension, double part, bool follower, bool beside_body = false, double speed = 0) {
  ModelBuilder builder(dimension);
  const int beam = add_bent_beam(builder, dimension);
  const double s = part * builder.beam(beam).curve.length();
  if (beside_body) add_sliding(builder, beam, s + 0.05);
  builder.add(PointLoad{
      {.beam = beam, .s = s, .speed = speed, .value = value(dimension), .follower = follower, .time = ramp}});
  return BeamSystem(builder.build());
}

// The smallest rotation that takes the drawn tangent to the present one.
Eigen::Vector3d turned(const Eigen::Vector3d& f, const Eigen::Vector3d& drawn, const Eigen::Vector3d& slope) {
  return Eigen::Quaterniond::FromTwoVectors(drawn, slope).toRotationMatrix() * f;
}

template <int D>
void check_force(double part, bool follower, bool beside_body) {
  std::mt19937 random(1);
  const BeamSystem system = loaded(D, part, follower, beside_body);
  const auto load = the_force<D, PointLoad>(system);
  const AffineMap map = random_map(D, random);
  State state = mapped_drawing(system, map);
  state.t = 0.2;
  state.load = 0.6;
  const ReferenceCurve& curve = system.model().beams[0].curve;
  const double s = part * curve.length();
  const Eigen::Vector3d t = curve.tangent(s), dead = 0.6 * 0.8 * value(D),
                        expected = follower ? turned(dead, t, map.F * t) : dead;
  const Resultant on_beam = resultant(system, state, -load.dynamics(state));
  expect_same(on_beam.force, expected);
  EXPECT_LT(on_beam.about(map(curve.position(s))).norm(), 1e-9);
  expect_actions(load, system, state, 0);
}
TEST(PointLoad, ActsAtItsPlaceDeadOrWithTheTangent) {
  for (const bool follower : {false, true}) {
    for (const double part : {0.0, 0.43, 1.0}) {
      check_force<2>(part, follower, false);
      check_force<3>(part, follower, false);
    }
    check_force<2>(0.5, follower, true);
    check_force<3>(0.5, follower, true);
  }
}

template <int D>
void check_derivatives(double part, bool follower, bool beside_body, double speed) {
  std::mt19937 random(2);
  const BeamSystem system = loaded(D, part, follower, beside_body, speed);
  const auto load = the_force<D, PointLoad>(system);
  State state = disturbed_state(system, random);
  state.t = 0.03;
  expect_tangent(load, state, random, 2e-3);
  expect_work_of_power(load, state);
}
TEST(PointLoad, HasTheDerivativesOfItsForceAndDoesItsWork) {
  for (const bool follower : {false, true})
    for (const double speed : {0.0, 0.4}) {
      for (const bool beside_body : {false, true}) {
        check_derivatives<2>(0.43, follower, beside_body, speed);
        check_derivatives<3>(0.43, follower, beside_body, speed);
      }
      check_derivatives<2>(0, follower, false, speed);
      check_derivatives<3>(1, follower, false, -speed);
    }
}

TEST(PointLoad, ThatHasLeftTheBeamDoesNothing) {
  std::mt19937 random(3);
  const BeamSystem system = loaded(3, 0.9, false, false, 1);
  const auto load = the_force<3, PointLoad>(system);
  State state = disturbed_state(system, random);
  state.t = 0.1;
  EXPECT_GT(load.dynamics(state).norm(), 0.1);
  state.t = 0.3;
  EXPECT_EQ(load.dynamics(state).norm(), 0);
  EXPECT_EQ(load.tangent(state, {.stiffness = 1}).norm(), 0);
  EXPECT_EQ(load.work(state, at_time(state, 0.1)), 0);
}

}  // namespace nurbeam::testing::point_load_test
