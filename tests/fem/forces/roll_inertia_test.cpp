#include "fem/forces/roll_inertia.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::roll_inertia_test {

constexpr int body = 0;
constexpr double inertia = 0.3;

enum class Carrier { node, fixed_element, beside_node };

BeamModel with_body(Carrier carrier) {
  ModelBuilder builder(3);
  const int beam = add_twisted_beam(builder);
  const double L = builder.beam(beam).curve.length();
  add_sliding(builder, beam, 0.4 * L,
              {.as_point = carrier != Carrier::node, .offset = Eigen::Vector2d(0.1, -0.2)});
  if (carrier == Carrier::beside_node) add_sliding(builder, beam, 0.46 * L);
  BeamModel model = builder.build();
  model.bodies[body].roll_inertia = inertia;
  return model;
}

template <class Check>
void for_each_carrier(const Check& check) {
  const BeamSystem node(with_body(Carrier::node));
  check(node, the_force<3, RollInertia<FollowedNode>>(node));
  for (const Carrier carrier : {Carrier::fixed_element, Carrier::beside_node}) {
    const BeamSystem point(with_body(carrier));
    check(point, the_force<3, RollInertia<FollowedPoint>>(point));
  }
}

// The body rolls with the section as far as the beam spins about the tangent there.
TEST(RollInertia, IsThatOfTheSpinAboutTheTangent) {
  for_each_carrier([](const BeamSystem& system, const auto& roll) {
    std::mt19937 random(1);
    const AffineMap motion = random_rigid_motion(3, random);
    State state = rigidly_moved(system, drawn_state(system), motion);
    const Eigen::Vector3d spin = random_vector(3, random),
                          t = motion.F *
                              system.model().beams[0].curve.tangent(state.q[place_of(system, body)]);
    state.v = rigid_rates(system, state, random_vector(3, random), spin);
    const double w = spin.dot(t);
    EXPECT_NEAR(roll.force.spin(roll.at(), state), w, 1e-8);
    EXPECT_NEAR(roll.energy(state).kinetic, inertia * w * w / 2, 1e-8);

    Eigen::VectorXd momentum = Eigen::VectorXd::Zero(system.coordinate_count());
    roll.force.add_momentum(roll.at(), state, w, momentum);
    const Resultant of_roll = resultant(system, state, momentum);
    EXPECT_LT(of_roll.force.norm(), 1e-8);
    expect_same(of_roll.moment, inertia * w * t, 1e-8);
  });
}

// What it takes of a motion goes into its kinetic energy.
TEST(RollInertia, TakesAsMuchPowerAsItsEnergyGrows) {
  for_each_carrier([](const BeamSystem& system, const auto& roll) {
    std::mt19937 random(2);
    const State state = disturbed_state(system, random);
    expect_rate_of_number([&](double h) { return roll.energy(at_time(state, h)).kinetic; },
                          roll.dynamics(state).dot(state.v), 1e-3);
  });
}

// That of a point where the places are at rest: what the force needs of their motion besides is left out of
// the tangent.
TEST(RollInertia, HasTheDerivativesOfItsForce) {
  for_each_carrier([](const BeamSystem& system, const auto& roll) {
    std::mt19937 random(3);
    State state = disturbed_state(system, random);
    if (!is_node(system, body))
      for (const int place : places_of(system)) state.v[place] = 0;
    expect_tangent(roll, state, random, 2e-3);
  });
}

TEST(RollInertia, OfAPointIsAMomentThere) {
  const BeamSystem system(with_body(Carrier::fixed_element));
  const auto roll = the_force<3, RollInertia<FollowedPoint>>(system);
  std::mt19937 random(4);
  const State state = disturbed_state(system, random);
  std::vector<PointAction> actions;
  roll.force.add_actions(roll.at(), state, actions);
  ASSERT_EQ(actions.size(), 1u);
  const Resultant on_beam = resultant(system, state, -roll.dynamics(state), coordinates_of_beam(system, 0));
  EXPECT_EQ(actions[0].force.norm(), 0);
  EXPECT_LT(on_beam.force.norm(), 1e-7);
  expect_same(on_beam.moment, actions[0].couple, 1e-7);
  EXPECT_NEAR(actions[0].s, state.q[place_of(system, body)], 1e-15);
}

// One that has left its beam keeps its energy.
TEST(RollInertia, OfABodyThatHasLeftIsItsEnergy) {
  const BeamModel model = with_body(Carrier::fixed_element);
  MeshPlan plan = initial_plan(model);
  plan.modes = {Carried::free};
  plan.spins = {1.5};
  const BeamSystem system(model, plan);
  SystemEnergy energy;
  const ForceIn<3, FreeRoll> free = the_force<3, FreeRoll>(system);
  free.force.add_energy(free.at(), drawn_state(system), energy);
  EXPECT_NEAR(energy.kinetic, inertia * 1.5 * 1.5 / 2, 1e-15);
  EXPECT_EQ((number_of<3, RollInertia<FollowedPoint>>(system)), 0);
}

TEST(RollInertia, IsThereWhereABodyHasOne) {
  BeamModel model = with_body(Carrier::node);
  model.bodies[body].roll_inertia = 0;
  EXPECT_EQ((number_of<3, RollInertia<FollowedNode>>(BeamSystem(model))), 0);
}

}  // namespace nurbeam::testing::roll_inertia_test
