#include "fem/forces/buffer_force.h"

#include "fem/forces/memory.h"
#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::buffer_force_test {

constexpr double gap = 0.3, stiffness = 200, damping = 5;
constexpr int first = 0, second = 1;

// One body before a buffer, or two with one between them, on a guide or on a beam.
BeamSystem at_buffer(int dimension, bool rigid, bool two) {
  ModelBuilder builder(dimension);
  const int beam = rigid ? builder.add_guide(bent_axis(dimension)) : add_bent_beam(builder, dimension, 16);
  add_sliding(builder, beam, 0.61);
  add_sliding(builder, beam, 1.02);
  BeamModel model = builder.build();
  model.stops = {two ? stop_between(model, first, second, gap) : stop_at(model, first, 0.7)};
  model.stops[0].buffer = Buffer{stiffness, damping};
  return BeamSystem(model);
}

// Pressed in by `depth`, which may be less than 0, at a speed, remembered so.
State pressed(const BeamSystem& system, bool two, double depth, double speed, BufferContact contact) {
  State state = drawn_state(system);
  state.memory = no_memory(system.mesh().memory);
  set_buffer_contact(system.mesh().memory, state.memory, 0, contact);
  const int place = place_of(system, first);
  state.q[place] = (two ? 1.02 - gap : 0.7) + depth;
  map_drawing(system, {}, state);
  if (system.mesh().nodes.empty() || system.model().beams[0].rigid) return state.v[place] = speed, state;
  // On a beam at rest a body that is a node moves along it.
  state.v[place] = speed;
  state.v.segment(position_of(system, first), system.dimension()) =
      speed * system.model().beams[0].curve.tangent(state.q[place]).head(system.dimension());
  return state;
}

template <class Check>
void for_each_buffer(const Check& check) {
  for (const bool rigid : {false, true})
    for (const bool two : {false, true}) {
      check(at_buffer(2, rigid, two), the_force<2, BufferForce<2>>, two);
      check(at_buffer(3, rigid, two), the_force<3, BufferForce<3>>, two);
    }
}

// Generalised force of a motion along the beam by which the buffer is pressed in, on the first body.
double along_beam(const BeamSystem& system, const Eigen::VectorXd& dynamics, const State& state) {
  const int place = place_of(system, first), body = position_of(system, first), D = system.dimension();
  double sum = -dynamics[place];
  if (!system.model().beams[0].rigid)
    sum -= dynamics.segment(body, D).dot(system.model().beams[0].curve.tangent(state.q[place]).head(D));
  return sum;
}

TEST(BufferForce, IsItsSpringWhereAStepBeginsAway) {
  for_each_buffer([](const BeamSystem& system, const auto& buffer_of, bool two) {
    const auto buffer = buffer_of(system, 0);
    const State in = pressed(system, two, 0.05, 1.3, BufferContact::away),
                out = pressed(system, two, -0.05, 1.3, BufferContact::away);
    EXPECT_NEAR(along_beam(system, buffer.dynamics(in), in), -stiffness * 0.05, 1e-9);
    EXPECT_EQ(buffer.dynamics(out).norm(), 0);
    EXPECT_NEAR(buffer.energy(in).spring, stiffness / 2 * 0.05 * 0.05, 1e-10);
    EXPECT_EQ(buffer.energy(out).spring, 0);
    EXPECT_TRUE(buffer.force.is_damper(buffer.at()));
  });
}

TEST(BufferForce, IsItsSpringAndItsDamperWhereItPresses) {
  for_each_buffer([](const BeamSystem& system, const auto& buffer_of, bool two) {
    const auto buffer = buffer_of(system, 0);
    const State in = pressed(system, two, 0.05, 1.3, BufferContact::pressing),
                back = pressed(system, two, 0.05, -4, BufferContact::pressing),
                let_go = pressed(system, two, 0.05, -4, BufferContact::let_go);
    EXPECT_NEAR(along_beam(system, buffer.dynamics(in), in), -(stiffness * 0.05 + damping * 1.3), 1e-9);
    // Below 0 it pulls in the trials of a step; let go it does nothing.
    EXPECT_NEAR(along_beam(system, buffer.dynamics(back), back), -(stiffness * 0.05 - damping * 4), 1e-9);
    EXPECT_EQ(buffer.dynamics(let_go).norm(), 0);
  });
}

TEST(BufferForce, HasTheDerivativesOfItsForceWhichComesOfItsEnergy) {
  for_each_buffer([](const BeamSystem& system, const auto& buffer_of, bool two) {
    std::mt19937 random(1);
    const auto buffer = buffer_of(system, 0);
    for (const BufferContact contact : {BufferContact::away, BufferContact::pressing}) {
      State state = pressed(system, two, 0.05, 0.4, contact);
      state.q += 0.01 * random_vector(state.q.size(), random);
      state.v += 0.1 * random_vector(state.v.size(), random);
      ASSERT_GT(buffer.energy(state).spring, 0);
      expect_tangent(buffer, state, random, 2e-3);
      expect_potential(buffer, state, random);
    }
  });
}

TEST(BufferForce, GivesBothBodiesTheOpposite) {
  std::mt19937 random(2);
  for (const bool spatial : {false, true}) {
    const BeamSystem system = at_buffer(spatial ? 3 : 2, false, true);
    State state = pressed(system, true, 0.05, 1.3, BufferContact::pressing);
    state.q += 0.01 * random_vector(state.q.size(), random);
    const auto check = [&](const auto& buffer) {
      const Eigen::VectorXd dynamics = buffer.dynamics(state),
                            on_first = buffer.force.on_body(buffer.at(), first, state),
                            on_second = buffer.force.on_body(buffer.at(), second, state);
      EXPECT_GT(on_first.norm(), 1);
      expect_same(on_first, -on_second);
      expect_same(-dynamics.segment(position_of(system, first), system.dimension()), on_first);
      expect_opposite(resultant(system, state, dynamics), {});
    };
    spatial ? check(the_force<3, BufferForce<3>>(system)) : check(the_force<2, BufferForce<2>>(system));
  }
}

// In and out again: what the spring stores comes back, what the damper takes does not.
TEST(BufferForce, LosesWhatItsDamperTakes) {
  for_each_buffer([](const BeamSystem& system, const auto& buffer_of, bool two) {
    const auto buffer = buffer_of(system, 0);
    for (const double speed : {1.3, -1.3}) {
      const auto at = [&](double h) {
        return pressed(system, two, 0.05 + h * speed, speed, BufferContact::pressing);
      };
      const auto loss = [&](double h) { return buffer.force.loss(buffer.at(), at(0), at(h)); };
      EXPECT_NEAR((loss(1e-3) - loss(-1e-3)) / 2e-3, damping * speed * speed, 1e-3);
      EXPECT_GT(loss(0.01), 0);
    }
  });
}

TEST(BufferForce, RemembersWhatTheBodyDoes) {
  const BeamSystem system = at_buffer(2, true, false);
  const auto buffer = the_force<2, BufferForce<2>>(system);
  const auto after = [&](double depth, double speed, BufferContact before) {
    State state = pressed(system, false, depth, speed, before);
    buffer.force.commit(buffer.at(), state, state.memory);
    return buffer_contact(system.mesh().memory, state.memory, 0);
  };
  EXPECT_EQ(after(0.05, 1, BufferContact::pressing), BufferContact::pressing);
  EXPECT_EQ(after(-0.01, -1, BufferContact::pressing), BufferContact::away);
  EXPECT_EQ(after(0.05, 1, BufferContact::let_go), BufferContact::pressing);
  EXPECT_EQ(after(0.05, -4, BufferContact::let_go), BufferContact::let_go);
  EXPECT_EQ(after(0.05, 1, BufferContact::away), BufferContact::away);  // an event says when it presses
}

}  // namespace nurbeam::testing::buffer_force_test
