#include "fem/constraints/sleeve.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::sleeve_test {

Eigen::Vector3d direction(int dimension) { return {1.5, 0.4, dimension == 3 ? -0.3 : 0}; }

BeamSystem in_sleeve(int dimension) {
  ModelBuilder builder(dimension);
  const int beam = add_bent_beam(builder, dimension);
  const double s = 0.4 * builder.beam(beam).curve.length();
  Rider& sleeve = builder.lead_through("sleeve", builder.beam(beam).curve.position(s), beam, s);
  sleeve.continuous_slope = true;
  sleeve.direction = direction(dimension);
  return BeamSystem(builder.build());
}

template <int D>
void check() {
  std::mt19937 random(1);
  const BeamSystem system = in_sleeve(D);
  const auto sleeve = the_constraint<D, HeldSlope<D>>(system);
  State state = disturbed_state(system, random);
  expect_derivatives(sleeve, state, random);
  const Mesh& mesh = system.mesh();
  const int slope = mesh.nodes[0][mesh.riders[0].node].slope_left;
  state.load = 1;
  state.q.segment<D>(slope) = 0.7 * direction(D).head<D>();
  EXPECT_LT(sleeve.value(state).norm(), 1e-13);
  const Eigen::Vector3d t = direction(D).normalized();
  state.q.segment<D>(slope) = direction(D).head<D>() + Eigen::Vector3d(0, 1, 0).head<D>();
  const Eigen::Vector3d rs = widened<D>(state.q.segment<D>(slope));
  EXPECT_NEAR(sleeve.value(state).norm(), (rs - rs.dot(t) * t).norm(), 1e-13);
  // Drawn, nothing is asked for.
  state.load = 0;
  const ReferenceCurve& curve = system.model().beams[0].curve;
  state.q.segment<D>(slope) = curve.tangent(system.model().riders[0].s).head<D>();
  EXPECT_LT(sleeve.value(state).norm(), 1e-13);
}
TEST(HeldSlope, LeavesTheDirectionOfTheSleeveAlone) {
  check<2>();
  check<3>();
}

}  // namespace nurbeam::testing::sleeve_test
