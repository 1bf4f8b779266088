#include "fem/model/build.h"

#include <gtest/gtest.h>

#include "fem/motion/run/simulation.h"
#include "fem/system/initial_state.h"
#include "fem/system/observables.h"
#include "solver/rest/static_equilibrium.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/system/consistent.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

ReferenceCurve line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int dimension = 2) {
  return ReferenceCurve({line_cubic(a, b)}, dimension);
}

TEST(ModelBuilder, PutsANodeWhereverSomethingIsHeldOrJoined) {
  ModelBuilder builder(2);
  const int a = builder.add_beam(line({0, 0, 0}, {1, 0, 0}), BeamProperties(300, 2, 0.7), {.elements = 5});
  const int b =
      builder.add_beam(line({0.33, 0, 0}, {0.33, 1, 0}), BeamProperties(300, 2, 0.7), {.elements = 3});
  builder.clamp(a, 0).pin(a, 0.71).join(a, 0.33, b, 0, true);
  const BeamModel model = builder.build();
  const Beam& beam = model.beams[a];
  EXPECT_EQ(beam.home_intervals(), 5);
  ASSERT_GE(beam.home_at(0.33), 0);
  ASSERT_GE(beam.home_at(0.71), 0);
  EXPECT_EQ(beam.home.front().hold, Hold::clamp);
  EXPECT_EQ(beam.home[beam.home_at(0.71)].hold, Hold::position);
  EXPECT_TRUE(beam.home[beam.home_at(0.33)].joined);
  EXPECT_EQ(beam.home[beam.home_at(0.33)].hold, Hold::nothing);
  EXPECT_TRUE(beam.home[beam.home_at(0.33)].permanent);
  EXPECT_TRUE(model.beams[b].home.front().joined);
}

template <class Act>
void expect_refusal(Act act, const std::string& part) {
  try {
    act();
    FAIL() << "nothing was thrown; expected " << part;
  } catch (const std::invalid_argument& refusal) {
    EXPECT_NE(std::string(refusal.what()).find(part), std::string::npos) << refusal.what();
  }
}

TEST(ModelBuilder, RefusesWhatCannotBeAndNamesTheValue) {
  ModelBuilder builder(2);
  expect_refusal([] { ModelBuilder(4); }, "got 4");
  expect_refusal(
      [&] {
        builder.add_beam(line({0, 0, 0}, {1, 0, 0}, 3), BeamProperties(1, 1, 1));
      },
      "dimension 3");
  expect_refusal(
      [&] {
        builder.add_beam(line({0, 0, 0}, {1, 0, 0}), BeamProperties(1, 1, 0));
      },
      "mass_per_length 0");
  const int beam = builder.add_beam(line({0, 0, 0}, {1, 0, 0}), BeamProperties(1, 1, 1), {.elements = 1});
  expect_refusal([&] { builder.pin(beam, -0.2); }, "-0.2");
  expect_refusal([&] { builder.pin(7, 0); }, "no beam 7");
  expect_refusal([&] { builder.add_body("stone", 0); }, "mass of 0");
  expect_refusal([&] { builder.slide(3, beam, 0.5); }, "no body 3");
  builder.pin(beam, 0.5);
  expect_refusal([&] { (void)builder.build(); }, "smallest count is 2");
}

TEST(BeamModel, MayBeCopiedMovedAndLostWhileItsSystemLives) {
  auto model = std::make_unique<BeamModel>(
      testing::one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {300, 2, 0.7}, 4, {{0, true}}));
  testing::add_slider(*model, 0.5, 0.4).motion = TimeTable{{0, 0.4}, {1, 0.6}};
  model->forces.push_back(PointLoad{{.s = 0.9, .value = {0, -1, 0}}});
  const BeamSystem system(*model);
  const auto residual = [&] {
    State state = drawn_state(system);
    state.t = 0.25;
    Eigen::VectorXd dynamics(system.coordinate_count()), constraints(system.constraint_count());
    system.residual(state, dynamics, constraints);
    return Eigen::VectorXd(dynamics + Eigen::VectorXd::Constant(dynamics.size(), constraints.sum()));
  };
  const Eigen::VectorXd before = residual();
  BeamModel moved = std::move(*model);
  moved.beams.clear();
  model.reset();
  EXPECT_EQ(residual(), before);
}

// A body that no joint holds falls freely.
TEST(Body, WithoutAJointFlies) {
  ModelBuilder builder(3, {0, 0, -9.81});
  const int beam =
      builder.add_beam(line({0, 0, 0}, {1, 0, 0}, 3), BeamProperties(300, 2, 0.7), {.elements = 2});
  builder.clamp(beam, 0);
  builder.add_body("stone", 0.3, {2, 1, 5}, {1, 0, 2});
  SimulationOptions options;
  options.end_time = 0.5;
  options.step = 1e-3;
  options.output_times = {0, 0.5};
  Snapshot last;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& snapshot) { last = snapshot; };
  EXPECT_EQ(simulate(builder.build(), {}, options, observer).status, SimulationStatus::done);
  const Eigen::Vector3d expected(2 + 0.5, 1, 5 + 2 * 0.5 - 9.81 / 2 * 0.25);
  EXPECT_LT((last.bodies[0].point.position - expected).norm(), 1e-6);
  EXPECT_FALSE(last.bodies[0].s);
}

// A ring that holds two crossing taut wires: it can slide along neither, and shares what pushes it between
// both.
TEST(Body, WithTwoJointsHoldsTwoBeamsTogether) {
  const auto sag = [](bool both) {
    ModelBuilder builder(3, {0, 0, -9.81});
    const BeamProperties wire(2e4, 1e-2, 0.05);
    const int x = builder.add_beam(line({-1, 0, 0}, {1, 0, 0}, 3), wire, {.elements = 8});
    builder.pin(x, 0).pin(x, 2);
    const int ring = builder.add_body("ring", 2);
    builder.slide(ring, x, 1);
    if (both) {
      const int y = builder.add_beam(line({0, -1, 0}, {0, 1, 0}, 3), wire, {.elements = 8});
      builder.pin(y, 0).pin(y, 2);
      builder.slide(ring, y, 1);
    }
    const BeamSystem system(builder.build());
    State state = drawn_state(system);
    EXPECT_EQ(find_static_equilibrium({}, system, state).status, StaticStatus::converged);
    if (both) {
      const Mesh& mesh = system.mesh();
      EXPECT_EQ(mesh.nodes[0][mesh.riders[0].node].r, mesh.nodes[1][mesh.riders[1].node].r);
    }
    return -state.q[system.mesh().bodies[ring] + 2];
  };
  // A taut wire resists with the cube of the sag: half the load each, sag smaller by the cube root of 2.
  const double alone = sag(false), shared = sag(true);
  EXPECT_NEAR(alone / shared, std::cbrt(2.0), 0.03);
}

}  // namespace
}  // namespace nurbeam
