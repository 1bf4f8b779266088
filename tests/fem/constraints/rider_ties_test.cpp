#include "fem/constraints/rider_ties.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::rider_ties_test {

constexpr int body = 0;
const Friction rubs{.coefficient = 0.2};

enum class Track { guide, beam, with_torsion };

BeamModel sliding_on(int dimension, Track track, const Sliding& how) {
  ModelBuilder builder(dimension);
  const int beam = track == Track::guide  ? builder.add_guide(bent_axis(dimension))
                   : track == Track::beam ? add_bent_beam(builder, dimension)
                                          : add_twisted_beam(builder);
  add_sliding(builder, beam, 0.7, how);
  return builder.build();
}

// The model in a plan with the body carried so.
BeamSystem carried(const BeamModel& model, Carried mode, bool held = false) {
  MeshPlan plan = initial_plan(model);
  plan.modes[static_cast<std::size_t>(body)] = mode;
  return BeamSystem(model, plan, {held});
}

template <int D>
void check_modes() {
  const BeamModel on_guide = sliding_on(D, Track::guide, {}), on_beam = sliding_on(D, Track::beam, {}),
                  as_point = sliding_on(D, Track::beam, {.as_point = true}),
                  rubbing = sliding_on(D, Track::beam, {.friction = rubs});
  const BeamSystem guide(on_guide), node(on_beam), point(as_point), apart(rubbing);
  EXPECT_EQ((count_of<D, BodyOnGuide<D>>(guide)), 1);
  EXPECT_EQ(guide.constraint_count(), D);
  EXPECT_EQ(node.constraint_count(), 0);  // the body is the node
  EXPECT_EQ(position_of(node, body), node_of(node, body).r);
  EXPECT_EQ((count_of<D, BodyOnPoint<D>>(point)), 1);
  EXPECT_EQ(point.constraint_count(), D);
  EXPECT_EQ((count_of<D, BodyOnNode<D>>(apart)), 1);
  EXPECT_EQ(apart.constraint_count(), D);

  const BeamSystem stopped = carried(as_point, Carried::stopped), left = carried(as_point, Carried::free);
  EXPECT_EQ((count_of<D, BodyOnPoint<D>>(stopped)), 1);
  EXPECT_EQ((count_of<D, HeldPlace<D>>(stopped)), 1);
  EXPECT_EQ(left.constraint_count(), 0);
  EXPECT_EQ((count_of<D, HeldPlace<D>>(carried(as_point, Carried::point, true))), 1);
  const BeamSystem moved(sliding_on(D, Track::beam, {.motion = TimeTable{{0, 0.7}, {1, 0.9}}}));
  EXPECT_EQ((count_of<D, HeldPlace<D>>(moved)), 1);
}
TEST(RiderTies, AreThoseOfHowABodyIsCarried) {
  check_modes<2>();
  check_modes<3>();
}

TEST(RiderTies, OfABeamWithTorsionKnowItsSections) {
  const Eigen::Vector2d beside(0.1, 0.2), none(0, 0);
  const BeamSystem node(sliding_on(3, Track::with_torsion, {.offset = beside})),
      point(sliding_on(3, Track::with_torsion, {.as_point = true, .offset = beside})),
      on_axis(sliding_on(3, Track::with_torsion, {.offset = none})),
      kinked(sliding_on(3, Track::with_torsion, {.kinked = true})),
      without(sliding_on(3, Track::beam, {.kinked = true}));
  EXPECT_EQ((count_of<3, BodyOnSection<FollowedNode>>(node)), 1);
  EXPECT_EQ(node.constraint_count(), 3);
  EXPECT_EQ((count_of<3, BodyOnSection<FollowedPoint>>(point)), 1);
  EXPECT_EQ(point.constraint_count(), 3);
  EXPECT_EQ(on_axis.constraint_count(), 0);
  EXPECT_EQ((count_of<3, PassedRoll>(kinked)), 1);
  EXPECT_EQ(kinked.constraint_count(), 1);
  EXPECT_EQ(without.constraint_count(), 0);
}

}  // namespace nurbeam::testing::rider_ties_test
