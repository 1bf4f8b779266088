#include "fem/constraints/kept_contact.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::kept_contact_test {

constexpr double gap = 0.3;
constexpr int first = 0, second = 1;

// One body at a stop, or two at a stop between them, on a guide or on a beam that carries them as nodes.
BeamSystem at_stop(int dimension, bool rigid, bool two) {
  ModelBuilder builder(dimension);
  const int beam = rigid ? builder.add_guide(bent_axis(dimension)) : add_bent_beam(builder, dimension, 16);
  add_sliding(builder, beam, 0.61);
  add_sliding(builder, beam, 1.02);
  BeamModel model = builder.build();
  model.stops = {two ? stop_between(model, first, second, gap) : stop_at(model, first, 0.7)};
  MeshPlan plan = initial_plan(model);
  plan.closed = {true};
  return BeamSystem(model, plan);
}

template <class Check>
void for_each_system(const Check& check) {
  for (const bool rigid : {false, true})
    for (const bool two : {false, true}) {
      check(at_stop(2, rigid, two), the_constraint<2, KeptContact<2>>, two);
      check(at_stop(3, rigid, two), the_constraint<3, KeptContact<3>>, two);
    }
}

// Two bodies on a drawn beam are as far as along it; on one that folds by as much less as their chord.
TEST(KeptContact, IsTheDistanceThatIsLeft) {
  for_each_system([](const BeamSystem& system, const auto& contact_of, bool two) {
    const auto contact = contact_of(system, 0);
    EXPECT_EQ(contact.constraint.closed_stop(), 0);
    State state = drawn_state(system);
    EXPECT_NEAR(contact.value(state)[0], two ? 1.02 - 0.61 - gap : 0.7 - 0.61, 1e-13);
    state.q[place_of(system, first)] += 0.02;
    if (system.model().beams[0].rigid || !two) {
      EXPECT_NEAR(contact.value(state)[0], two ? 1.02 - 0.63 - gap : 0.7 - 0.63, 1e-13);
      return;
    }
    const AffineMap map{1.1 * Eigen::Matrix3d::Identity()};
    map_drawing(system, map, state);
    const ReferenceCurve& curve = system.model().beams[0].curve;
    const double chord = (curve.position(1.02) - curve.position(0.63)).norm();
    EXPECT_NEAR(contact.value(state)[0], 1.02 - 0.63 - gap + 0.1 * chord, 1e-13);
  });
}

TEST(KeptContact, HasTheDerivativesOfItsValue) {
  for_each_system([](const BeamSystem& system, const auto& contact_of, bool) {
    std::mt19937 random(1);
    expect_derivatives(contact_of(system, 0), disturbed_state(system, random, 0.02), random);
  });
}

// The multiplier is less than 0 where they press against each other: it pushes the body back that is before
// the stop.
TEST(KeptContact, PushesBodiesApartAlongTheirBeam) {
  for_each_system([](const BeamSystem& system, const auto& contact_of, bool two) {
    const auto contact = contact_of(system, 0);
    const State state = drawn_state(system);
    const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, -2.5), forces = contact.forces(state, y);
    const bool by_places = !two || system.model().beams[0].rigid;
    const int D = system.dimension();
    Eigen::VectorXd on_first = contact.constraint.on_body(first, state, y),
                    on_second = contact.constraint.on_body(second, state, y);
    if (by_places) {
      EXPECT_NEAR(forces[place_of(system, first)], -2.5, 1e-13);
      if (two) EXPECT_NEAR(forces[place_of(system, second)], 2.5, 1e-13);
      EXPECT_EQ(on_first.norm() + on_second.norm(), 0);
      return;
    }
    const Eigen::VectorXd apart =
        (state.q.segment(position_of(system, second), D) - state.q.segment(position_of(system, first), D))
            .normalized();
    expect_same(on_first, -2.5 * apart);
    expect_same(on_second, 2.5 * apart);
    expect_same(forces.segment(position_of(system, first), D), on_first);
    expect_same(forces.segment(position_of(system, second), D), on_second);
  });
}

template <int D>
void check_rigid_motion() {
  std::mt19937 random(2);
  const BeamSystem system = at_stop(D, false, true);
  const State state = disturbed_state(system, random, 0.02);
  const auto contact = the_constraint<D, KeptContact<D>>(system);
  const State moved = rigidly_moved(system, state, random_rigid_motion(D, random));
  EXPECT_NEAR(contact.value(moved)[0], contact.value(state)[0], 1e-12);
  expect_opposite(resultant(system, state, contact.forces(state, Eigen::VectorXd::Ones(1))), {});
}
TEST(KeptContact, BetweenTwoBodiesIsAPairOfOppositeForces) {
  check_rigid_motion<2>();
  check_rigid_motion<3>();
}

TEST(KeptContact, IsThereAsLongAsAStopIsClosed) {
  for (const bool two : {false, true}) {
    const BeamSystem closed = at_stop(3, false, two);
    EXPECT_EQ((count_of<3, KeptContact<3>>(closed)), 1);
    EXPECT_EQ((count_of<3, KeptContact<3>>(BeamSystem(closed.model()))), 0);
  }
}

}  // namespace nurbeam::testing::kept_contact_test
