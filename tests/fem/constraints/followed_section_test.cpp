#include "fem/constraints/followed_section.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::followed_section_test {

constexpr int body = 0;

BeamSystem with_body(bool as_point) {
  ModelBuilder builder(3);
  const int beam = add_twisted_beam(builder);
  add_sliding(builder, beam, 0.4 * builder.beam(beam).curve.length(),
              {.as_point = as_point, .offset = Eigen::Vector2d(0.1, 0)});
  return BeamSystem(builder.build());
}

// In a rigid motion of the drawing, wherever the body has come to there.
template <class Section>
void check_triad(bool as_point, double shift) {
  const BeamSystem system = with_body(as_point);
  const MeshedBeams<3> at = system.assembly<3>()->beams();
  const Section section(at, drawn_state(system).q, tie_of(system.model(), body));
  std::mt19937 random(1);
  const AffineMap motion = random_rigid_motion(3, random);
  State state = drawn_state(system);
  if (as_point) shift_places(system, state, shift);
  state = rigidly_moved(system, state, motion);
  const auto x = section.coordinates(at, state.q);
  const DrawnSection drawn = system.model().beams[0].curve.section(state.q[place_of(system, body)]);
  Eigen::Matrix3d triad;
  triad << drawn.d1, drawn.d2, drawn.t;
  const Eigen::Matrix3d found = section.here(at, x).template triad<double>(x).matrix();
  EXPECT_LT((found - motion.F * triad).norm(), 1e-12);
}

TEST(FollowedSection, IsCarriedByARigidMotion) {
  check_triad<FollowedNode>(false, 0);
  for (const double shift : {-0.02, 0.0, 0.04}) check_triad<FollowedPoint>(true, shift);
}

TEST(FollowedSection, LeavesOutCoordinatesThatAMeshHasNot) {
  const Eigen::Vector3d values(4, 5, 6);
  EXPECT_EQ(gathered(std::array<int, 3>{2, -1, 0}, values), Eigen::Vector3d(6, 0, 4));
}

}  // namespace nurbeam::testing::followed_section_test
