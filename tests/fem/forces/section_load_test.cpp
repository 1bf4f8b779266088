#include "fem/forces/section_load.h"

#include "fem/forces/moment.h"
#include "fem/forces/point_load.h"
#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::section_load_test {

const Eigen::Vector3d value(1, -2, 0.7);
const Eigen::Vector2d beside(0.1, 0.2), none(0, 0);

struct Place {
  double part;
  bool beside_body;
};
constexpr Place places[] = {{0, false}, {0.43, false}, {1, false}, {0.5, true}};

template <class Load>
BeamSystem loaded(const Place& at, bool follower, const Eigen::Vector2d& offset) {
  ModelBuilder builder(3);
  const int beam = add_twisted_beam(builder);
  const double s = at.part * builder.beam(beam).curve.length();
  if (at.beside_body) add_sliding(builder, beam, s + 0.05);
  builder.add(Load{{.beam = beam,
                    .s = s,
                    .value = value,
                    .follower = follower,
                    .time = {{0, 0.5}, {1, 2}},
                    .offset = offset}});
  return BeamSystem(builder.build());
}

// Where the axis is at the load, and from there to where it acts.
struct Arm {
  Eigen::Vector3d foot, arm;

  Arm(const BeamSystem& system, const Place& at, const Eigen::Vector2d& offset, const AffineMap& motion) {
    const ReferenceCurve& curve = system.model().beams[0].curve;
    const double s = at.part * curve.length();
    const DrawnSection section = curve.section(s, at.part == 1);
    foot = motion(curve.position(s));
    arm = motion.F * (offset[0] * section.d1 + offset[1] * section.d2);
  }
};

TEST(SectionLoad, OfAForceIsThatForceBesideTheAxis) {
  for (const Place& at : places)
    for (const bool follower : {false, true})
      for (const Eigen::Vector2d& offset : {none, beside}) {
        std::mt19937 random(1);
        const BeamSystem system = loaded<PointLoad>(at, follower, offset);
        const auto load = the_force<3, PointLoad>(system);
        const AffineMap motion = random_rigid_motion(3, random);
        State state = rigidly_moved(system, drawn_state(system), motion);
        state.t = 0.2;
        state.load = 0.6;
        const Eigen::Vector3d dead = 0.6 * 0.8 * value,
                              f = follower ? Eigen::Vector3d(motion.F * dead) : dead;
        const Arm there(system, at, offset, motion);
        const Resultant on_beam = resultant(system, state, -load.dynamics(state));
        expect_same(on_beam.force, f);
        expect_same(on_beam.about(there.foot), there.arm.cross(f));
        expect_actions(load, system, state, 0);
      }
}

TEST(SectionLoad, OfAMomentIsAllOfIt) {
  for (const Place& at : places)
    for (const bool follower : {false, true}) {
      std::mt19937 random(2);
      const BeamSystem system = loaded<Moment>(at, follower, none);
      const auto moment = the_force<3, Moment>(system);
      const AffineMap motion = random_rigid_motion(3, random);
      State state = rigidly_moved(system, drawn_state(system), motion);
      state.t = 0.2;
      state.load = 0.6;
      const Eigen::Vector3d dead = 0.6 * 0.8 * value, m = follower ? Eigen::Vector3d(motion.F * dead) : dead;
      const Resultant on_beam = resultant(system, state, -moment.dynamics(state));
      EXPECT_LT(on_beam.force.norm(), 1e-8);
      expect_same(on_beam.moment, m);
      expect_actions(moment, system, state, 0);
    }
}

template <class Load>
void check_derivatives(const Place& at, bool follower, const Eigen::Vector2d& offset) {
  std::mt19937 random(3);
  const BeamSystem system = loaded<Load>(at, follower, offset);
  const auto load = the_force<3, Load>(system);
  State state = disturbed_state(system, random);
  state.t = 0.3;
  expect_tangent(load, state, random);
  expect_work_of_power(load, state);
}
TEST(SectionLoad, HasTheDerivativesOfItsForceAndDoesItsWork) {
  for (const Place& at : places)
    for (const bool follower : {false, true}) {
      check_derivatives<PointLoad>(at, follower, none);
      check_derivatives<PointLoad>(at, follower, beside);
      check_derivatives<Moment>(at, follower, none);
    }
}

// A dead force on the axis needs no section.
TEST(SectionLoad, IsAskedForWhereTheSectionMatters) {
  const BeamSystem system = loaded<PointLoad>(places[1], false, none);
  ModelBuilder builder(3);
  const int round = add_bent_beam(builder, 3);
  const BeamModel without = builder.build();
  LoadAtPlace load{.beam = 0, .s = 0.3, .value = value};
  EXPECT_FALSE(works_on_section(load, OnSection::force, system.model()));
  EXPECT_TRUE(works_on_section(load, OnSection::moment, system.model()));
  load.follower = true;
  EXPECT_TRUE(works_on_section(load, OnSection::force, system.model()));
  load.beam = round;
  EXPECT_FALSE(works_on_section(load, OnSection::moment, without));
}

}  // namespace nurbeam::testing::section_load_test
