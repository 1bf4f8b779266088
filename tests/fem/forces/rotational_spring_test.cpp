#include "fem/forces/rotational_spring.h"

#include <cmath>
#include <numbers>

#include "fem/forces/memory.h"
#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/rigid_bodies.h"

namespace nurbeam::testing::rotational_spring_test {

using std::numbers::pi;
constexpr double stiffness = 7, damping = 0.6, free_angle = 0.3, moment = 0.5;

struct Made {
  int dimension;
  bool torsion;
  bool to_space;  // else to a second beam
  bool has_axis;
};
constexpr Made all_kinds[] = {{2, false, true, true},  {2, false, false, true}, {3, false, true, true},
                              {3, false, false, true}, {3, true, true, true},   {3, true, false, true},
                              {3, true, true, false},  {3, true, false, false}};

Eigen::Vector3d axis(int dimension) {
  return dimension == 2 ? Eigen::Vector3d(0, 0, -1) : Eigen::Vector3d(0.2, -0.3, 1).normalized();
}

BeamSystem with_spring(const Made& made) {
  ModelBuilder builder(made.dimension);
  made.torsion ? add_twisted_beam(builder) : add_bent_beam(builder, made.dimension);
  const double L = builder.beam(0).curve.length();
  Grip other = Grip::at_point({0, 0, 0});
  if (!made.to_space) {
    const ReferenceCurve curve({going_on(made.dimension)}, made.dimension);
    other = Grip::on_beam(
        builder.add_beam(curve, made.torsion ? with_sections() : BeamProperties(300, 2, 0.7), {4}), 0);
  }
  BeamModel model = builder.build();
  RotationalConnector connector{
      .name = "hinge", .ends = {other, Grip::on_beam(0, L)}, .stiffness = stiffness, .damping = damping};
  if (made.has_axis) {
    connector.axis = axis(made.dimension);
    connector.angle = free_angle;
    connector.moment = moment;
  }
  model.rotational_connectors.push_back(connector);
  mark_held_nodes(model);
  return BeamSystem(model);
}

template <class Check>
void for_each_spring(const Check& check) {
  for (const Made& made : all_kinds) {
    SCOPED_TRACE(::testing::Message() << made.dimension << made.torsion << made.to_space << made.has_axis);
    if (made.dimension == 2)
      check(with_spring(made), the_force<2, RotationalSpring<2>>, made);
    else
      check(with_spring(made), the_force<3, RotationalSpring<3>>, made);
  }
}

TEST(RotationalSpring, HasTheDerivativesOfItsForceWhichComesOfItsEnergy) {
  for_each_spring([](const BeamSystem& system, const auto& spring_of, const Made&) {
    std::mt19937 random(3);
    const auto spring = spring_of(system, 0);
    State state = disturbed_state(system, random, 0.1);
    state.memory = no_memory(system.mesh().memory);
    expect_tangent(spring, state, random);
    expect_potential(spring, state, random);
  });
}

// The turn of the first beam as a whole, from its drawing; the second one stays.
State turned(const BeamSystem& system, double angle, const Eigen::Vector3d& about) {
  State state = drawn_state(system);
  const State moved =
      rigidly_moved(system, state, {Eigen::AngleAxisd(angle, about.normalized()).toRotationMatrix()});
  for (const int i : coordinates_of_beam(system, 0)) state.q[i] = moved.q[i];
  return state;
}

TEST(RotationalSpring, CountsTheAngleAboutItsAxis) {
  for_each_spring([](const BeamSystem& system, const auto& spring_of, const Made& made) {
    const auto spring = spring_of(system, 0);
    const double sign = 1;
    Eigen::VectorXd memory = no_memory(system.mesh().memory);
    for (double angle = 0; angle <= 9; angle += 0.5) {
      State state = turned(system, angle, axis(made.dimension));
      state.memory = memory;
      const auto [phi, M] = spring.force.angle_and_moment(spring.at(), state);
      if (made.has_axis) {
        EXPECT_NEAR(phi, sign * angle, 1e-11);
        EXPECT_NEAR(M, stiffness * (angle - free_angle) + moment, 1e-9);
        EXPECT_NEAR(spring.energy(state).spring, M * M / (2 * stiffness), 1e-8);
      } else if (angle < 3) {
        EXPECT_NEAR(phi, angle, 1e-8);
        EXPECT_NEAR(M, stiffness * angle, 1e-7);
        EXPECT_NEAR(spring.energy(state).spring, stiffness / 2 * angle * angle, 1e-7);
        EXPECT_EQ(spring.force.admissible(state), angle < 170 * pi / 180);
      }
      spring.force.commit(spring.at(), state, memory);
    }
  });
}

// A moment about the axis, or about that of the turn; as much on the other end.
TEST(RotationalSpring, TurnsItsEndsBackTogether) {
  for_each_spring([](const BeamSystem& system, const auto& spring_of, const Made& made) {
    const auto spring = spring_of(system, 0);
    const Eigen::Vector3d u = axis(made.dimension);
    State state = turned(system, 0.8, u);
    const double M = spring.force.angle_and_moment(spring.at(), state).second;
    const Eigen::VectorXd forces = -spring.dynamics(state);
    const Resultant on_first = resultant(system, state, forces, coordinates_of_beam(system, 0));
    EXPECT_LT(on_first.force.norm(), 1e-9);
    // On a direction no moment along it is possible: about the axis it is the whole one.
    EXPECT_NEAR(on_first.moment.dot(u), -M, 1e-8);
    if (made.torsion) expect_same(on_first.moment, Eigen::Vector3d(-M * u), 1e-8);
    if (!made.to_space && made.torsion)
      expect_opposite(on_first, resultant(system, state, forces, coordinates_of_beam(system, 1)));
  });
}

TEST(RotationalSpring, LosesWhatItsDamperTakes) {
  for_each_spring([](const BeamSystem& system, const auto& spring_of, const Made&) {
    std::mt19937 random(4);
    const auto spring = spring_of(system, 0);
    State state = disturbed_state(system, random, 0.1);
    state.memory = no_memory(system.mesh().memory);
    State still = state;
    still.v.setZero();
    const double power = (spring.dynamics(state) - spring.dynamics(still)).dot(state.v);
    const auto loss = [&](double step) {
      return spring.force.loss(spring.at(), state, at_time(state, step));
    };
    EXPECT_GT(power, 0);
    EXPECT_NEAR((loss(1e-3) - loss(-1e-3)) / 2e-3, power, 1e-3 * (1 + power));
    EXPECT_TRUE(spring.force.is_damper(spring.at()));
  });
}

TEST(RotationalSpring, NeedsAnAxisWithoutTorsion) {
  EXPECT_THROW(with_spring({3, false, true, false}), std::invalid_argument);
}

// ---- Of rigid bodies ----

enum class Other { space, body, section };

// The second end is a place of the first body.
BeamSystem on_bodies(Other kind, bool has_axis) {
  ModelBuilder builder(3);
  const int beam = add_twisted_beam(builder);
  const int body = add_tumbling_body(builder), other = add_tumbling_body(builder, "other", {1, 0, 0});
  const int place = builder.add_point("place", body, {0.4, 0.1, 0});
  const Grip first = kind == Other::space  ? Grip::at_point({0, 0, 0})
                     : kind == Other::body ? Grip::on_body(other)
                                           : Grip::on_beam(beam, builder.beam(beam).curve.end());
  BeamModel model = builder.build();
  RotationalConnector connector{
      .name = "hinge", .ends = {first, Grip::on_body(place)}, .stiffness = stiffness, .damping = damping};
  if (has_axis) {
    connector.axis = axis(3);
    connector.angle = free_angle;
    connector.moment = moment;
  }
  model.rotational_connectors.push_back(connector);
  mark_held_nodes(model);
  return BeamSystem(model);
}

template <class Check>
void for_each_on_bodies(const Check& check) {
  for (const Other kind : {Other::space, Other::body, Other::section})
    for (const bool has_axis : {true, false}) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(kind) << has_axis);
      check(on_bodies(kind, has_axis), kind, has_axis);
    }
}

TEST(RotationalSpringOfBodies, HasTheDerivativesOfItsForceWhichComesOfItsEnergy) {
  for_each_on_bodies([](const BeamSystem& system, Other, bool) {
    std::mt19937 random(5);
    const auto spring = the_force<3, RotationalSpring<3>>(system, 0);
    State state = disturbed_state(system, random, 0.1);
    state.memory = no_memory(system.mesh().memory);
    expect_tangent(spring, state, random);
    expect_potential(spring, state, random);
  });
}

// Counted over turns about an axis that goes with the first end; the moment turns the body back.
TEST(RotationalSpringOfBodies, CountsTheAngleOfTheBodyAndTurnsItBack) {
  const Eigen::Quaterniond first(Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, -2, 0.5).normalized()));
  for (const bool has_axis : {true, false}) {
    const BeamSystem system = on_bodies(Other::body, has_axis);
    const auto spring = the_force<3, RotationalSpring<3>>(system, 0);
    const Eigen::Vector3d u = axis(3);
    Eigen::VectorXd memory = no_memory(system.mesh().memory);
    for (double angle = 0; angle <= (has_axis ? 9 : 2.9); angle += 0.5) {
      State state = drawn_state(system);
      put(system, state, 1, {1, 0, 0}, first);
      put(system, state, 0, tumbling_at, first * Eigen::Quaterniond(Eigen::AngleAxisd(angle, u)));
      state.v.setZero();
      state.memory = memory;
      const auto [phi, M] = spring.force.angle_and_moment(spring.at(), state);
      EXPECT_NEAR(phi, angle, 1e-8);
      EXPECT_NEAR(M, has_axis ? stiffness * (angle - free_angle) + moment : stiffness * angle, 1e-7);
      // Its work on a spin about the axis, as it is then, of each.
      for (const auto& [body, sign] : {std::pair{0, -1.0}, {1, 1.0}}) {
        const int p = system.mesh().attitudes[body];
        const Eigen::Vector4d rate = attitude::rate(state.q.segment<4>(p), first * u);
        EXPECT_NEAR(-spring.dynamics(state).segment<4>(p).dot(rate), sign * M, 1e-7);
      }
      spring.force.commit(spring.at(), state, memory);
    }
  }
}

TEST(RotationalSpringOfBodies, IsNoneOfAPointMass) {
  ModelBuilder builder(3);
  const int mass = builder.add_body("mass", 1, {0, 0, 0});
  BeamModel model = builder.build();
  model.rotational_connectors.push_back(
      {.name = "hinge", .ends = {Grip::at_point({0, 0, 0}), Grip::on_body(mass)}, .stiffness = 1});
  EXPECT_THROW(BeamSystem{model}, std::invalid_argument);
}

}  // namespace nurbeam::testing::rotational_spring_test
