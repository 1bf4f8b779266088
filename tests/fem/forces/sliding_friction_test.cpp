#include "fem/forces/sliding_friction.h"

#include "fem/forces/memory.h"
#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::sliding_friction_test {

constexpr int body = 0;
constexpr double mu = 0.3, viscous = 0.7, stick = 500;
enum class Carrier { guide, point, node, kinked_node };
constexpr Carrier carriers[] = {Carrier::guide, Carrier::point, Carrier::node, Carrier::kinked_node};

// The tie of the body is the only constraint: its multipliers are the force on it.
BeamSystem rubbing(int dimension, Carrier carrier) {
  ModelBuilder builder(dimension);
  const int beam =
      carrier == Carrier::guide ? builder.add_guide(bent_axis(dimension)) : add_bent_beam(builder, dimension);
  add_sliding(builder, beam, 0.7,
              {.kinked = carrier == Carrier::kinked_node,
               .as_point = carrier == Carrier::point,
               .friction = Friction{.coefficient = mu, .viscous = viscous, .stick_stiffness = stick}});
  return BeamSystem(builder.build());
}

template <class Check>
void for_each_carrier(const Check& check) {
  for (const Carrier carrier : carriers) {
    check(rubbing(2, carrier), the_force<2, SlidingFriction<2>>, carrier);
    check(rubbing(3, carrier), the_force<3, SlidingFriction<3>>, carrier);
  }
}

// A state that goes on from that memory.
State remembering(const BeamSystem& system, State state, const FrictionMemory& memory) {
  state.memory = no_memory(system.mesh().memory);
  set_friction_memory(system.mesh().memory, state.memory, tie_of(system.model(), body), memory);
  return state;
}

// On an image of the drawing the slope is known; the jump of the tension is mu times the force across it.
TEST(SlidingFriction, IsTheCoefficientTimesTheForceAcrossTheBeam) {
  for_each_carrier([](const BeamSystem& system, const auto& friction_of, Carrier carrier) {
    std::mt19937 random(1);
    const int D = system.dimension();
    const auto friction = friction_of(system, 0);
    AffineMap map = random_map(D, random);
    if (carrier == Carrier::guide) map = {};
    const int place = place_of(system, body);
    State drawn = mapped_drawing(system, map);
    drawn.lambda = random_vector(drawn.lambda.size(), random);
    for (const double speed : {1.4, -1.4}) {
      drawn.v[place] = speed;
      const State state = remembering(system, drawn, {0, 0.7, speed > 0 ? 1 : -1});
      const Eigen::Vector3d slope = map.F * system.model().beams[0].curve.tangent(state.q[place]),
                            t = slope.normalized();
      Eigen::Vector3d force = Eigen::Vector3d::Zero();
      force.head(D) = state.lambda.head(D);
      const double across = (force - t.dot(force) * t).norm(), l = slope.norm(),
                   along = -(speed > 0 ? 1 : -1) * mu * across - viscous * l * speed;
      const Eigen::VectorXd dynamics = friction.dynamics(state);
      EXPECT_NEAR(-dynamics[place], l * along, 1e-8);
      EXPECT_NEAR(dynamics.norm(), std::abs(dynamics[place]), 1e-15);  // on the place alone
      EXPECT_NEAR(friction.force.friction(friction.at(), state).along, along, 1e-8);
    }
  });
}

TEST(SlidingFriction, HoldsABodyThatSticksByItsSpring) {
  for_each_carrier([](const BeamSystem& system, const auto& friction_of, Carrier carrier) {
    const auto friction = friction_of(system, 0);
    std::mt19937 random(2);
    AffineMap map = random_map(system.dimension(), random);
    if (carrier == Carrier::guide) map = {};
    State state = mapped_drawing(system, map);
    state.lambda.setConstant(100);
    const int place = place_of(system, body);
    const double l = (map.F * system.model().beams[0].curve.tangent(state.q[place])).norm();
    state = remembering(system, state, {0.001, state.q[place] - 0.002, 0});
    EXPECT_NEAR(-friction.dynamics(state)[place], -l * stick * (0.001 + l * 0.002), 1e-9);
    EXPECT_NEAR(friction.energy(state).spring, stick / 2 * 0.001 * 0.001, 1e-15);
  });
}

TEST(SlidingFriction, HasTheDerivativesOfItsForceByTheForceAcrossToo) {
  for_each_carrier([](const BeamSystem& system, const auto& friction_of, Carrier) {
    const auto friction = friction_of(system, 0);
    for (const int slides : {1, -1, 0}) {
      std::mt19937 random(3);
      State state = disturbed_state(system, random);
      state.lambda *= slides == 0 ? 1000 : 1;  // far from the bound of what can be held
      state.lambda.array() += 0.5;
      state.v[place_of(system, body)] = slides == 0 ? 0 : slides;
      state = remembering(system, state, {0.001, 0.6999, slides});
      expect_tangent(friction, state, random, 1e-3);
    }
  });
}

TEST(SlidingFriction, LosesEnergyWhichWayEverABodySlides) {
  for_each_carrier([](const BeamSystem& system, const auto& friction_of, Carrier) {
    const auto friction = friction_of(system, 0);
    for (const int slides : {1, -1}) {
      std::mt19937 random(4);
      State state = disturbed_state(system, random);
      state.a.setZero();
      state.v.setZero();
      state.v[place_of(system, body)] = slides;
      state = remembering(system, state, {0, 0.7, slides});
      const auto loss = [&](double h) {
        return friction.force.loss(friction.at(), state, at_time(state, h));
      };
      const double rate = friction.dynamics(state)[place_of(system, body)] * slides;
      EXPECT_GT(rate, 0);
      EXPECT_NEAR((loss(1e-3) - loss(-1e-3)) / 2e-3, rate, 1e-3 * rate);
      EXPECT_GT(loss(0.01), 0);
    }
  });
}

TEST(SlidingFriction, RemembersWhereItSlidesAndWhereItSticks) {
  for_each_carrier([](const BeamSystem& system, const auto& friction_of, Carrier) {
    const auto friction = friction_of(system, 0);
    State state = drawn_state(system);
    state.lambda.setConstant(2);
    const int place = place_of(system, body), tie = tie_of(system.model(), body);
    const auto after = [&](double s, double rate, const FrictionMemory& before) {
      State now = state;
      now.q[place] = s;
      now.v[place] = rate;
      now = remembering(system, now, before);
      friction.force.commit(friction.at(), now, now.memory);
      return friction_memory(system.mesh().memory, now.memory, tie);
    };
    EXPECT_EQ(after(0.7, 1, {0, 0.69, 1}).slides, 1);
    EXPECT_EQ(after(0.7, -1, {0, 0.71, -1}).slides, -1);
    EXPECT_EQ(after(0.7, -1, {0, 0.71, 1}).slides, 0);  // turned round
    EXPECT_EQ(after(0.7, 0, {0, 0.7, 0}).slides, 0);
    EXPECT_EQ(after(0.75, 0, {0, 0.7, 0}).slides, 1);  // pulled loose
    EXPECT_EQ(after(0.7, 1, {0, 0.69, 1}).s, 0.7);
  });
}

TEST(SlidingFriction, IsNoneInAStateWithoutMemoryAndOfABodyThatIsHeld) {
  for_each_carrier([](const BeamSystem& system, const auto& friction_of, Carrier) {
    const auto friction = friction_of(system, 0);
    State state = drawn_state(system);
    state.lambda.setConstant(2);
    state.v[place_of(system, body)] = 1;
    EXPECT_EQ(friction.dynamics(state).norm(), 0);
    EXPECT_EQ(friction.tangent(state, {.damping = 1, .stiffness = 1}).norm(), 0);
    EXPECT_EQ(friction.energy(state).spring, 0);
    MeshPlan held = initial_plan(system.model());
    held.held = {true};
    const BeamSystem still(system.model(), held);
    EXPECT_EQ((number_of<2, SlidingFriction<2>>(rubbing(2, Carrier::point))), 1);
    if (system.dimension() == 2) EXPECT_EQ((number_of<2, SlidingFriction<2>>(still)), 0);
    if (system.dimension() == 3) EXPECT_EQ((number_of<3, SlidingFriction<3>>(still)), 0);
  });
}

}  // namespace nurbeam::testing::sliding_friction_test
