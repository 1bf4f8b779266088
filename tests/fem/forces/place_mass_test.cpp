#include "fem/forces/place_mass.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"

namespace nurbeam::testing::place_mass_test {

constexpr double mass = 1.7;
const Eigen::Vector3d gravity(0.3, -9.81, 0);

// At the ends of a beam and between them.
template <int D>
void check_place_mass(double part, bool weighs) {
  std::mt19937 random(1);
  ModelBuilder builder(D, gravity);
  const int beam = add_bent_beam(builder, D);
  const double s = part * builder.beam(beam).curve.length();
  builder.add(PlaceMass{.beam = beam, .s = s, .mass = mass, .weighs = weighs});
  const BeamSystem system(builder.build());
  const auto lump = the_force<D, BoundPlaceMass<D>>(system);
  State state = disturbed_state(system, random);
  state.load = 0.6;
  const double weighed = weighs ? mass : 0;
  const Eigen::Vector3d a =
      widened<D>(material_point(lump.at().element_at(state.q, beam, s), state.q, state.a, s).velocity);
  const MaterialPoint<D> p = material_point(lump.at().element_at(state.q, beam, s), state.q, state.v, s);
  const Resultant needed = resultant(system, state, lump.dynamics(state));
  expect_same(needed.force, mass * a - 0.6 * weighed * gravity);
  EXPECT_LT(needed.about(widened<D>(p.r)).norm(), 1e-9);
  expect_same(lump.force.momentum(state), mass * p.velocity, 1e-13);
  EXPECT_NEAR(lump.energy(state).kinetic, mass / 2 * p.velocity.squaredNorm(), 1e-12);
  EXPECT_NEAR(lump.energy(state).gravity, -weighed * gravity.head<D>().dot(p.r), 1e-12);
  Eigen::VectorXd momentum = Eigen::VectorXd::Zero(system.coordinate_count());
  lump.force.add_momentum_of(widened<D>(p.velocity), momentum);
  expect_same(momentum, lump.tangent(state, {.mass = 1}).topLeftCorner(lump.n, lump.n) * state.v, 1e-13);
  expect_tangent(lump, state, random);
  state.load = 1;
  expect_potential(lump, state, random);
}
TEST(PlaceMass, IsInertiaAndWeightOfItsPlace) {
  for (const double part : {0.0, 0.4, 1.0})
    for (const bool weighs : {false, true}) {
      check_place_mass<2>(part, weighs);
      check_place_mass<3>(part, weighs);
    }
}

TEST(PlaceMass, NeedsANodeThatStays) {
  ModelBuilder builder(3);
  const int beam = add_bent_beam(builder, 3);
  const BeamSystem system(builder.build());
  const MeshedBeams<3> at = system.assembly<3>()->beams();
  const PlaceMass between{.beam = beam, .s = 0.123, .mass = mass};
  EXPECT_THROW(BoundPlaceMass<3>(between, at, drawn_state(system).q), std::invalid_argument);
}

}  // namespace nurbeam::testing::place_mass_test
