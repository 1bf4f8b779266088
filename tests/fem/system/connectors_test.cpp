// Connectors, lumped masses and guided supports in a system: tangents are rates, forces come of energies, and
// changes of the mesh lose no momentum.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fem/motion/run/simulation.h"
#include "fem/system/initial_state.h"
#include "solver/system/tangent_matrix.h"
#include "tests/fem/random_models.h"

namespace nurbeam::testing {
namespace {

BeamModel connected_model(std::mt19937& random, int dimension) {
  ModelBuilder builder(dimension, {0.3, -9, dimension == 3 ? 0.7 : 0});
  const int a = builder.add_beam(ReferenceCurve(uneven_axis(random, dimension), dimension),
                                 BeamProperties(300, 2, 0.7, 0.02), {8});
  builder.clamp(a, 0).guide(a, 1.9, {0.8, 0.6, dimension == 3 ? 0.3 : 0});
  const int slider = builder.add_body("slider", 0.8), load = builder.add_body("load", 2, {1, -0.7, 0}),
            other = builder.add_body("other", 1.5, {0.4, -0.9, 0});
  builder.slide(slider, a, 0.6, 0.4);
  const auto on = [&](double s) { return Grip::on_beam(a, s); };
  const auto fastened = [&](Grip from, Grip to, ConnectorType type) -> Connector& {
    Connector& c = builder.connect(from, to, type, 40);
    c.damping = 3;
    return c;
  };
  fastened(on(1.1), Grip::on_body(load), ConnectorType::spring);
  fastened(on(0.8), Grip::on_body(other), ConnectorType::tension_only).rows =
      ForceRows({{-1, -90}, {0, 0}, {0.05, 1}, {4, 300}});
  fastened(Grip::on_body(slider), Grip::on_body(load), ConnectorType::tension_only).length = 0.1;
  fastened(on(0.3), Grip::at_point({0.3, -1, 0}), ConnectorType::compression_only).length = 3;
  Connector& upright = fastened(on(1.5), Grip::on_body(other), ConnectorType::spring);
  upright.direction = Eigen::Vector3d(0, -1, 0);
  builder.connect(Grip::on_body(slider), Grip::on_body(other), ConnectorType::rod);
  builder.add(PlaceMass{.beam = a, .s = 1.1, .mass = 0.5});
  builder.add(PlaceMass{.beam = a, .s = 1.9, .mass = 0.9, .weighs = false});
  return builder.build();
}

Eigen::VectorXd residual_of(const BeamSystem& system, const State& state) {
  Eigen::VectorXd f(system.coordinate_count() + system.constraint_count());
  system.residual(state, f.head(system.coordinate_count()), f.tail(system.constraint_count()));
  return f;
}

TEST(ConnectedSystem, TangentsAreRatesOfForces) {
  std::mt19937 random(7);
  for (const int dimension : {2, 3}) {
    const BeamSystem system(connected_model(random, dimension));
    const State state = disturbed_state(system, random, 0.02);
    const int n = system.coordinate_count();
    const auto along = [&](const TangentWeights& w) { return tangent_matrix(system, state, w); };
    const Eigen::SparseMatrix<double> K = along({.stiffness = 1}), C = along({.damping = 1}),
                                      M = along({.mass = 1});
    std::uniform_real_distribution<double> unit(-1, 1);
    double last = 0;
    for (const double h : {1e-3, 1e-4}) {
      double error = 0, size = 0;
      for (int trial = 0; trial < 3; ++trial) {
        std::mt19937 same(trial);
        Eigen::VectorXd d(n);
        for (double& x : d) x = unit(same);
        State up = state, down = state, faster = state, slower = state, more = state, less = state;
        up.q += h * d;
        down.q -= h * d;
        faster.v += h * d;
        slower.v -= h * d;
        more.a += h * d;
        less.a -= h * d;
        const Eigen::VectorXd by_q = (residual_of(system, up) - residual_of(system, down)) / (2 * h),
                              by_v = (residual_of(system, faster) - residual_of(system, slower)) / (2 * h),
                              by_a = (residual_of(system, more) - residual_of(system, less)) / (2 * h);
        const auto product = [&](const Eigen::SparseMatrix<double>& A) {
          return Eigen::VectorXd(A.leftCols(n) * d);
        };
        error = std::max(error, (by_q - product(K)).lpNorm<Eigen::Infinity>());
        size = std::max(size, by_q.lpNorm<Eigen::Infinity>());
        EXPECT_LT((by_v - product(C)).head(n).lpNorm<Eigen::Infinity>(), 1e-6 * size);
        EXPECT_LT((by_a - product(M)).head(n).lpNorm<Eigen::Infinity>(), 1e-6 * size);
      }
      if (last > 0) EXPECT_LT(error, 0.02 * last + 1e-8 * size);
      last = error;
    }
  }
}

// Between its constraints a model loses what its dampers take: the rate of its energy is minus the power.
TEST(ConnectedSystem, EnergyIsWhatForcesWorkAgainst) {
  std::mt19937 random(11);
  for (const int dimension : {2, 3}) {
    const BeamSystem system(connected_model(random, dimension));
    State state = disturbed_state(system, random, 0.02);
    state.lambda.setZero();
    for (const MeshRider& joint : system.mesh().riders)
      if (joint.place >= 0) state.v[joint.place] = 0;
    State still = state;
    still.v.setZero();
    still.a.setZero();
    const Eigen::VectorXd f = residual_of(system, still).head(system.coordinate_count());
    const double h = 1e-5;
    State after = still, before = still;
    after.q += h * state.v;
    before.q -= h * state.v;
    const double rate = (energy(system, after).mechanical() - energy(system, before).mechanical()) / (2 * h);
    EXPECT_NEAR(f.dot(state.v), rate, 1e-6 * f.norm() * state.v.norm());
    State moving = state;
    moving.a.setZero();
    const Eigen::VectorXd lost = residual_of(system, moving).head(system.coordinate_count()) - f;
    State slow = moving;
    slow.v *= 0.5;
    const Eigen::VectorXd less = residual_of(system, slow).head(system.coordinate_count()) - f;
    // Of linear dampers: what is of first order in the velocities works as the dissipation of the beams says,
    // and what connectors lose on a short way.
    State there = moving, here = moving;
    there.q += h * state.v;
    here.q -= h * state.v;
    const double of_connectors = lost_energy(system, here, there) / (2 * h);
    EXPECT_GT(of_connectors, 0);
    EXPECT_NEAR((4 * less - lost).dot(state.v), energy(system, moving).dissipation + of_connectors,
                1e-6 * lost.norm() * state.v.norm());
  }
}

SimulationReport glide(const BeamModel& model, double end, std::vector<Snapshot>& frames,
                       std::vector<RunEvent>& events, double step = 2e-4) {
  SimulationOptions options;
  options.end_time = end;
  options.step = step;
  options.length_control.min = 0.2;
  for (int i = 0; i <= 20; ++i) options.output_times.push_back(end * i / 20);
  options.integrator = GeneralizedAlpha{.rho_infinity = 0.9};
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& frame) { frames.push_back(frame); };
  const SimulationReport report = simulate(model, {}, options, observer);
  events = report.events;
  return report;
}

// A body runs over a beam in flight, over clamps that weigh as much as it does: splits, merges and changes
// between point and node leave momentum and energy.
TEST(PlaceMass, KeepsItsMomentumWhereTheMeshChanges) {
  for (const bool kinks : {false, true}) {
    SCOPED_TRACE(kinks);
    ModelBuilder builder(2);
    const int b = builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 2),
                                   BeamProperties(2e4, kinks ? 0.05 : 5, 1), {10});
    builder.beam(b).velocity = BeamVelocity{.translation = {0.3, -0.2, 0}, .rotation = {0, 0, 0.4}};
    builder.add(PlaceMass{.beam = b, .s = 0.73, .mass = 0.5});
    builder.add(PlaceMass{.beam = b, .s = 1.31, .mass = 0.7});
    builder.slide(builder.add_body("trolley", 0.5), b, 0.3, 1.5).continuous_slope = !kinks;
    std::vector<Snapshot> frames;
    std::vector<RunEvent> events;
    const SimulationReport report = glide(builder.build(), 0.8, frames, events);
    ASSERT_FALSE(report.failure);
    int points = 0, merges = 0;
    for (const RunEvent& event : events) {
      points += event.kind == EventKind::becomes_point ? 1 : 0;
      merges += event.kind == EventKind::merge ? 1 : 0;
      EXPECT_LT((event.momentum_after - event.momentum_before).norm(), 1e-10);
      EXPECT_NEAR(event.energy_after, event.energy_before, 1e-6);
    }
    EXPECT_GE(points, kinks ? 1 : 2);
    EXPECT_GE(merges, 2);
    const double lost = std::abs(frames.back().energy.total - frames.front().energy.total);
    // A chain whips: waves run into the element that shrinks before the trolley, faster and faster. The steps
    // that follow them keep their energy.
    EXPECT_LT(lost, kinks ? 1e-2 : 2e-4);
    if (!kinks) continue;
    std::vector<Snapshot> fine;
    ASSERT_FALSE(glide(builder.build(), 0.8, fine, events, 2.5e-5).failure);
    EXPECT_LT(std::abs(fine.back().energy.total - fine.front().energy.total), 2e-4);
  }
}

// Slack and taut by turns, with lengths that the equilibrium gives, while a trolley runs over their places.
TEST(ConnectedSystem, GoesOnFromACheckpointBitByBit) {
  ModelBuilder builder(2, {0, -9.81, 0});
  BeamProperties wire(1e6, 2, 1);
  wire.free_strain.of_tension = -2e3 / 1e6;
  wire.damping = wire.tension_damping = 1e-3;
  wire.mass_damping = 0.1;
  const int b = builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {4, 0, 0})}, 2), wire, {16});
  builder.pin(b, 0).guide(b, 4, {1, 0, 0}).force(b, 4, {2e3, 0, 0});
  for (const double s : {1.0, 2.0, 3.0}) {
    Connector& dropper =
        builder.connect(Grip::on_beam(b, s), Grip::at_point({s, 1, 0}), ConnectorType::tension_only, 2e4);
    dropper.damping = 20;
    dropper.length_rule = ConnectorLength::as_drawn;
    builder.add(PlaceMass{.beam = b, .s = s, .mass = 0.2});
  }
  builder.slide(builder.add_body("trolley", 1), b, 0.6, 3);
  const BeamModel model = builder.build();
  SimulationOptions options;
  options.start_from_equilibrium = true;
  options.end_time = 0.8;
  options.step = 1e-3;
  options.output_times = {0, 0.8};
  Checkpoint middle, end, resumed;
  int steps = 0;
  SimulationObserver observer;
  observer.checkpoint_due = [&] { return ++steps == 400; };
  observer.checkpoint = [&](const Checkpoint& now) { (steps <= 400 ? middle : end) = now; };
  ASSERT_FALSE(simulate(model, {}, options, observer).failure);
  ASSERT_EQ(middle.connector_lengths.size(), 3u);
  EXPECT_NE(middle.connector_lengths[0], 1);
  SimulationObserver again;
  again.checkpoint = [&](const Checkpoint& now) { resumed = now; };
  ASSERT_FALSE(simulate(model, {}, options, again, &middle).failure);
  EXPECT_EQ(resumed.state.t, end.state.t);
  EXPECT_EQ(resumed.state.q, end.state.q);
  EXPECT_EQ(resumed.state.v, end.state.v);
  EXPECT_EQ(resumed.dissipated, end.dissipated);
  EXPECT_EQ(resumed.connector_lengths, end.connector_lengths);
  EXPECT_LT(std::abs(end.report.energy_drift), 0.01 * end.report.peak_kinetic_energy);
}

// What a connector's end and a mass stand on is a node that never gives way.
TEST(PlaceMass, NeedsItsNode) {
  ModelBuilder builder(2);
  const int b = builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 2),
                                 BeamProperties(2e4, 5, 1), {10});
  BeamModel model = builder.clamp(b, 0).build();
  model.forces.push_back(PlaceMass{.beam = b, .s = 0.33, .mass = 1});
  EXPECT_THROW(BeamSystem{model}, std::invalid_argument);
  model.forces.clear();
  model.connectors.push_back({.name = "c", .ends = {Grip::on_beam(b, 0.33), Grip::at_point({0, 1, 0})}});
  EXPECT_THROW(BeamSystem{model}, std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam::testing
