#include "fem/forces/rigid_inertia.h"

#include "tests/fem/bound_force.h"
#include "tests/fem/rigid_bodies.h"

namespace nurbeam::testing::rigid_inertia_test {

const Eigen::Vector3d spinning(0.3, -0.2, 0.4);  // [N m s]

BeamSystem tumbling(const Eigen::Vector3d& rotor) {
  ModelBuilder builder(3);
  builder.body(add_tumbling_body(builder)).rigid->rotor = rotor;
  return BeamSystem(builder.build());
}

// A state with a spin and its rate, both along own axes.
State turning(const BeamSystem& system, const Eigen::Vector3d& spin, const Eigen::Vector3d& rate) {
  State state = drawn_state(system);
  const int first = system.mesh().attitudes[0];
  const Eigen::Vector4d p = Eigen::Vector4d(0.7, -0.4, 0.2, 0.5).normalized();
  const Eigen::Vector4d v = attitude::from_moment<double>(p, spin) / 2;
  state.q.segment<4>(first) = p;
  state.v.segment<4>(first) = v;
  state.a.segment<4>(first) = attitude::from_moment<double>(p, rate) / 2 - p * v.squaredNorm();
  return state;
}

// The power of what it asks for along any spin is that of Euler's moment.
TEST(RigidInertia, IsEulersMoment) {
  std::mt19937 random(1);
  for (const Eigen::Vector3d& rotor : {Eigen::Vector3d(0, 0, 0), spinning}) {
    const BeamSystem system = tumbling(rotor);
    const auto inertia = the_force<3, RigidInertia>(system);
    const Eigen::Vector3d w = random_vector(3, random), rate = random_vector(3, random);
    const State state = turning(system, w, rate);
    const int first = system.mesh().attitudes[0];
    const Eigen::Vector4d p = state.q.segment<4>(first);
    const Eigen::Matrix3d J = general_inertia();
    const Eigen::Vector3d moment = J * rate + w.cross(J * w + rotor), along = random_vector(3, random);
    EXPECT_NEAR(inertia.dynamics(state).segment<4>(first).dot(attitude::from_moment<double>(p, along) / 2),
                moment.dot(along), 1e-14);
    EXPECT_NEAR(inertia.dynamics(state).segment<4>(first).dot(p), 0, 1e-14);
    EXPECT_NEAR(inertia.energy(state).kinetic, w.dot(J * w) / 2, 1e-14);
  }
}

TEST(RigidInertia, HasTheTangentOfItsForceForQuaternionsOfAnyLength) {
  std::mt19937 random(2);
  const BeamSystem system = tumbling(spinning);
  expect_tangent(the_force<3, RigidInertia>(system), general_state(system, random), random);
}

// Its momentum is what its mass matrix makes of the rates, where the attitude keeps its length.
TEST(RigidInertia, CarriesItsMomentum) {
  std::mt19937 random(3);
  const BeamSystem system = tumbling({0, 0, 0});
  const auto inertia = the_force<3, RigidInertia>(system);
  const State state = turning(system, random_vector(3, random), {0, 0, 0});
  Eigen::VectorXd p = Eigen::VectorXd::Zero(inertia.n);
  inertia.force.add_momentum_in(system.mesh(), state, p);
  expect_same(p, inertia.tangent(state, {.mass = 1}).topLeftCorner(inertia.n, inertia.n) * state.v, 1e-14);
}

}  // namespace nurbeam::testing::rigid_inertia_test
