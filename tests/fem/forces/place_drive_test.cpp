#include "fem/forces/place_drive.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::place_drive_test {

constexpr double inertia = 1.7;
const TimeTable force{{0, 3}, {2, -5}};

// Along a beam, carried as a node or as a point of the mesh.
template <int D>
void check_drive(bool as_point) {
  std::mt19937 random(1);
  ModelBuilder builder(D);
  const int beam = add_bent_beam(builder, D);
  const double s = 0.4 * builder.beam(beam).curve.length();
  const int body = builder.add_body("pulley", 0.8);
  Rider& rider = builder.slide(body, beam, s);
  rider.as_point = as_point;
  rider.turning_inertia = inertia;
  rider.drive_force = force;
  const BeamSystem system(builder.build());
  const auto drive = the_force<D, PlaceDrive<D>>(system);
  State state = disturbed_state(system, random);
  state.t = 0.5;
  state.load = 0.6;
  const int place = place_of(system, body);
  const double f = 0.6 * (3 - 8 * 0.25);
  Eigen::VectorXd needed = Eigen::VectorXd::Zero(drive.n);
  needed[place] = inertia * state.a[place] - f;
  expect_same(drive.dynamics(state), needed, 1e-13);
  EXPECT_NEAR(drive.energy(state).kinetic, inertia / 2 * state.v[place] * state.v[place], 1e-13);
  EXPECT_NEAR(drive.power(state), f * state.v[place], 1e-13);
  expect_tangent(drive, state, random);
  State to = state;
  to.q[place] += 0.3;
  to.t = 1;  // then the force is -1 N
  EXPECT_NEAR(drive.work(state, to), 0.3 * 0.6 * (1 - 1) / 2.0, 1e-13);
  to.t = 0.75;  // and here it is 0
  EXPECT_NEAR(drive.work(state, to), 0.3 * 0.6 * (1 + 0) / 2.0, 1e-13);
}
TEST(PlaceDrive, IsInertiaAndForceAlongTheBeam) {
  for (const bool as_point : {false, true}) {
    check_drive<2>(as_point);
    check_drive<3>(as_point);
  }
}

}  // namespace nurbeam::testing::place_drive_test
