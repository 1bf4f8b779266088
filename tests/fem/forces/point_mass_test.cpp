#include "fem/forces/point_mass.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::point_mass_test {

constexpr double mass = 1.7;
const Eigen::Vector3d gravity(0.3, -9.81, 0);

template <int D>
void check_point_mass() {
  std::mt19937 random(1);
  ModelBuilder builder(D, gravity);
  const int body = builder.add_body("body", mass, {1, 2, 0});
  const BeamSystem system(builder.build());
  const auto inertia = the_force<D, PointMass<D>>(system);
  State state = disturbed_state(system, random);
  state.load = 0.6;
  const Eigen::Matrix<double, D, 1> a = state.a.segment<D>(position_of(system, body)),
                                    v = state.v.segment<D>(position_of(system, body)),
                                    r = state.q.segment<D>(position_of(system, body));
  expect_same(inertia.dynamics(state).segment(position_of(system, body), D),
              mass * (a - 0.6 * gravity.head<D>()), 1e-14);
  expect_same(inertia.force.momentum(state), mass * v, 1e-14);
  EXPECT_NEAR(inertia.energy(state).kinetic, mass / 2 * v.squaredNorm(), 1e-13);
  EXPECT_NEAR(inertia.energy(state).gravity, -mass * gravity.head<D>().dot(r), 1e-13);
  expect_tangent(inertia, state, random);
  state.load = 1;
  expect_potential(inertia, state, random);
}
TEST(PointMass, IsInertiaAndWeight) {
  check_point_mass<2>();
  check_point_mass<3>();
}

}  // namespace nurbeam::testing::point_mass_test
