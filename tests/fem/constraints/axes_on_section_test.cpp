#include "fem/constraints/axes_on_section.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"
#include "tests/fem/rigid_bodies.h"

namespace nurbeam::testing::axes_on_section_test {

enum class On { guide, node, point };

// A rigid body whose point runs on a bent beam or guide.
BeamSystem following(On on, Follows follows) {
  ModelBuilder builder(3);
  const ReferenceCurve axis =
      bent_axis(3).oriented({Orientation::Rule::start, {0.3, 0.2, 1}, {{0, 0}, {4, 2}}});
  const int beam = on == On::guide ? builder.add_guide(axis) : add_twisted_beam(builder);
  const double s = 0.4 * builder.beam(beam).curve.length();
  const Eigen::Vector3d at = builder.beam(beam).curve.position(s);
  const int body = add_tumbling_body(builder, "body", at + Eigen::Vector3d(0.1, 0.2, 0.3));
  builder.body(body).rigid->attitude = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 1, 0).normalized());
  Rider& rider = builder.slide(builder.add_point("wheel", body, at), beam, s);
  rider.as_point = on == On::point;
  rider.follows = follows;
  rider.follow_axis = Eigen::Vector3d(1, -1, 0.4).normalized();
  return BeamSystem(builder.build());
}

template <class Section, int N>
void check(On on, Follows follows, int seed) {
  std::mt19937 random(seed);
  const BeamSystem system = following(on, follows);
  const auto axes = the_constraint<3, AxesOnSection<Section, N>>(system);
  EXPECT_LT(axes.value(drawn_state(system)).norm(), 1e-12);
  State state = disturbed_state(system, random);
  for (const int p : system.mesh().attitudes)
    if (p >= 0) state.q.segment<4>(p) = random_vector(4, random);
  expect_derivatives(axes, state, random);
}
template <class Section>
void check_all(On on, int seed) {
  check<Section, 2>(on, Follows::axis, seed);
  check<Section, 2>(on, Follows::tangent, seed + 1);
  check<Section, 3>(on, Follows::section, seed + 2);
}

TEST(AxesOnSection, HasTheDerivativesOfItsValueOnAGuide) { check_all<GuideSection>(On::guide, 1); }
TEST(AxesOnSection, HasTheDerivativesOfItsValueAtANode) { check_all<FollowedNode>(On::node, 4); }
TEST(AxesOnSection, HasTheDerivativesOfItsValueAtAPoint) { check_all<FollowedPoint>(On::point, 7); }

// What a couple of the multipliers does as the section turns is what their forces on its coordinates do.
TEST(AxesOnSection, TellsTheCoupleOnABeamThatItRunsThrough) {
  std::mt19937 random(10);
  const BeamSystem system = following(On::point, Follows::section);
  const auto axes = the_constraint<3, AxesOnSection<FollowedPoint, 3>>(system);
  const State state = drawn_state(system);
  const Eigen::Vector3d y = random_vector(3, random);
  const auto action = axes.constraint.action(axes.in.beams(), state, y);
  ASSERT_TRUE(action.has_value());
  const Resultant on_beam = resultant(system, state, axes.forces(state, y), coordinates_of_beam(system, 0));
  expect_same(on_beam.force, Eigen::Vector3d::Zero(), 1e-12);
  expect_same(on_beam.moment, action->couple, 1e-9);
}

}  // namespace nurbeam::testing::axes_on_section_test
