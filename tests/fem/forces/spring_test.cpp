#include "fem/forces/spring.h"

#include "fem/forces/memory.h"
#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::spring_test {

constexpr int slider = 0, load = 1;
constexpr double held_at = 0.9, stiffness = 40, damping = 3;

enum class Between { body_and_body, beam_and_body, point_and_body, beam_and_point };
constexpr Between all_kinds[] = {Between::body_and_body, Between::beam_and_body, Between::point_and_body,
                                 Between::beam_and_point};

struct Made {
  Between between = Between::body_and_body;
  ConnectorType type = ConnectorType::spring;
  double length = 0.3;
  bool directed = false;
};

Eigen::Vector3d along(int dimension) {
  return Eigen::Vector3d(0.6, -0.7, dimension == 3 ? 0.4 : 0).normalized();
}

BeamSystem with_spring(int dimension, const Made& made) {
  ModelBuilder builder(dimension);
  const int beam = add_bent_beam(builder, dimension);
  add_sliding(builder, beam, 0.4);
  builder.add_body("load", 2, {1, -0.6, dimension == 3 ? 0.3 : 0});
  const auto point = end_at({0.2, 0.9, 0});
  const auto from = made.between == Between::body_and_body    ? end_on_body(slider)
                    : made.between == Between::point_and_body ? point
                                                              : end_on_beam(beam, held_at);
  auto& spring = builder.connect(from, made.between == Between::beam_and_point ? point : end_on_body(load),
                                 made.type, stiffness);
  spring.damping = damping;
  spring.length = made.length;
  if (made.directed) spring.direction = along(dimension);
  return BeamSystem(builder.build());
}

template <class Check>
void for_each_spring(const Check& check) {
  for (const Between between : all_kinds)
    for (const bool directed : {false, true}) {
      const Made made{.between = between, .directed = directed};
      check(with_spring(2, made), the_force<2, Spring<2>>, made);
      check(with_spring(3, made), the_force<3, Spring<3>>, made);
    }
}

// From the first end to the second, and what of it counts.
Eigen::Vector3d line(const BeamSystem& system, const State& state) {
  const auto [from, to] = connector_ends(system, state, 0);
  return to - from;
}
double size_of(const BeamSystem& system, const State& state, const Made& made) {
  const Eigen::Vector3d d = line(system, state);
  return made.directed ? d.dot(along(system.dimension())) : d.norm();
}

TEST(Spring, PullsWithStretchAndItsRate) {
  for_each_spring([](const BeamSystem& system, const auto& spring_of, const Made& made) {
    std::mt19937 random(1);
    const auto spring = spring_of(system, 0);
    const State state = disturbed_state(system, random);
    const double h = 1e-4;
    const double rate =
        (size_of(system, at_time(state, h), made) - size_of(system, at_time(state, -h), made)) / (2 * h);
    const double N = stiffness * (size_of(system, state, made) - made.length) + damping * rate;
    const auto [length, force] = spring.force.length_and_force(spring.at(), state);
    EXPECT_NEAR(length, size_of(system, state, made), 1e-13);
    EXPECT_NEAR(force, N, 1e-5);
    EXPECT_TRUE(spring.force.is_damper(spring.at()));

    const int D = system.dimension();
    const Eigen::Vector3d n = made.directed ? along(D) : line(system, state).normalized();
    const Eigen::VectorXd on_load = spring.force.on_body(spring.at(), load, state),
                          on_slider = spring.force.on_body(spring.at(), slider, state);
    if (made.between == Between::body_and_body) expect_same(on_slider, force * n.head(D));
    if (made.between != Between::beam_and_point) {
      expect_same(on_load, -force * n.head(D));
      expect_same(-spring.dynamics(state).segment(position_of(system, load), D), on_load);
    }
  });
}

TEST(Spring, DoesTheOppositeToBothEnds) {
  for_each_spring([](const BeamSystem& system, const auto& spring_of, const Made& made) {
    std::mt19937 random(2);
    const auto spring = spring_of(system, 0);
    const State state = disturbed_state(system, random);
    const Eigen::Vector3d n = made.directed ? along(system.dimension()) : line(system, state).normalized();
    const double N = spring.force.length_and_force(spring.at(), state).second;
    const Resultant whole = resultant(system, state, -spring.dynamics(state));
    const bool inner = made.between == Between::body_and_body || made.between == Between::beam_and_body;
    if (inner) EXPECT_LT(whole.force.norm(), 1e-8);
    if (inner && !made.directed) EXPECT_LT(whole.moment.norm(), 1e-8);
    if (made.between == Between::point_and_body) expect_same(whole.force, -N * n);
    if (made.between == Between::beam_and_point) expect_same(whole.force, N * n);
  });
}

TEST(Spring, HasTheDerivativesOfItsForceWhichComesOfItsEnergy) {
  for_each_spring([](const BeamSystem& system, const auto& spring_of, const Made& made) {
    std::mt19937 random(3);
    const auto spring = spring_of(system, 0);
    const State state = disturbed_state(system, random);
    expect_tangent(spring, state, random);
    expect_potential(spring, state, random);
    const double e = size_of(system, state, made) - made.length;
    EXPECT_NEAR(spring.energy(state).spring, stiffness / 2 * e * e, 1e-11);
  });
}

// What it takes of the motion and does not store is lost: c e'^2.
TEST(Spring, LosesWhatItsDamperTakes) {
  for_each_spring([](const BeamSystem& system, const auto& spring_of, const Made& made) {
    std::mt19937 random(4);
    const auto spring = spring_of(system, 0);
    const State state = disturbed_state(system, random);
    const double h = 1e-4;
    const double rate =
        (size_of(system, at_time(state, h), made) - size_of(system, at_time(state, -h), made)) / (2 * h);
    const auto loss = [&](double step) {
      return spring.force.loss(spring.at(), state, at_time(state, step));
    };
    EXPECT_NEAR((loss(1e-3) - loss(-1e-3)) / 2e-3, damping * rate * rate, 1e-3 * (1 + damping * rate * rate));
    EXPECT_GE(loss(0.01), 0);
  });
}

// Those of one sign carry on their side alone, and pull as a spring does there.
template <int D>
void check_one_sign(ConnectorType type) {
  std::mt19937 random(5);
  const double sign = type == ConnectorType::tension_only ? 1 : -1;
  for (const bool carries : {false, true}) {
    const BeamSystem system = with_spring(D, {.type = type, .length = (sign > 0) == carries ? 0.2 : 2.0});
    const auto spring = the_force<D, Spring<D>>(system);
    State state = disturbed_state(system, random);
    state.memory = no_memory(system.mesh().memory);
    EXPECT_EQ(spring.force.carries(spring.at(), state), carries);
    EXPECT_TRUE(spring.force.carries_one_sign(spring.at()));
    spring.force.commit(spring.at(), state, state.memory);
    EXPECT_EQ(is_taut(system.mesh().memory, state.memory, 0), carries);
    const double N = spring.force.length_and_force(spring.at(), state).second;
    if (carries) EXPECT_GT(sign * N, 0);
    if (!carries) EXPECT_EQ(spring.dynamics(state).norm(), 0);
    expect_tangent(spring, state, random);
    expect_potential(spring, state, random);
    EXPECT_EQ(spring.tangent(state, {.damping = 1}).norm() > 0, carries);
  }
}
TEST(Spring, OfOneSignCarriesOnItsSideAlone) {
  for (const ConnectorType type : {ConnectorType::tension_only, ConnectorType::compression_only}) {
    check_one_sign<2>(type);
    check_one_sign<3>(type);
  }
}

// Held on its other side, as the search for rest asks for it, the law goes on over its kink.
TEST(Spring, OfOneSignHeldOnASideIsLinear) {
  std::mt19937 random(6);
  const BeamSystem system = with_spring(3, {.type = ConnectorType::tension_only, .length = 2});
  const auto spring = the_force<3, Spring<3>>(system);
  State state = disturbed_state(system, random);
  const Made made{.length = 2};
  state.sides = Eigen::VectorXd::Ones(spring.force.side(spring.at()) + 1);
  state.v.setZero();
  const double e = size_of(system, state, made) - made.length;
  EXPECT_NEAR(spring.force.length_and_force(spring.at(), state).second, stiffness * e, 1e-12);
  expect_tangent(spring, state, random);
  state.sides.setZero();
  EXPECT_EQ(spring.dynamics(state).norm(), 0);
}

// Ends in one place: no line, and no division by its length.
TEST(Spring, OfNoLengthHasAFiniteTangent) {
  const BeamSystem system = with_spring(3, {});
  const auto spring = the_force<3, Spring<3>>(system);
  State state = drawn_state(system);
  state.q.segment<3>(position_of(system, load)) = state.q.segment<3>(position_of(system, slider));
  EXPECT_EQ(spring.dynamics(state).norm(), 0);
  EXPECT_TRUE(spring.tangent(state, {.stiffness = 1}).allFinite());
  EXPECT_GT(spring.tangent(state, {.stiffness = 1}).norm(), 0);
}

}  // namespace nurbeam::testing::spring_test
