#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "fem/motion/run/simulation.h"
#include "pipelines/results/restart_file.h"
#include "tests/pipelines/case_text.h"
#include "tests/pipelines/frames.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

using test::expect_equal;
using test::TemporaryDirectory;

// A bar that is held at one end, with a body that slides off the other.
BeamModel falling_beam() {
  BeamModel model = testing::one_beam({testing::line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                                      testing::round_bar(0.02, 7200, 2e6), 6, {{0, true}});
  testing::add_slider(model, 0.8, 0.2);
  return model;
}

SimulationOptions options_with(const decltype(SimulationOptions::integrator)& integrator,
                               std::optional<double> step) {
  SimulationOptions options;
  options.end_time = 0.8;
  options.step = step;
  for (int i = 0; i <= 20; ++i) options.output_times.push_back(0.04 * i);
  options.integrator = integrator;
  return options;
}

struct Played {
  SimulationReport report;
  std::vector<Snapshot> frames;
  std::vector<Checkpoint> points;
};

// Runs a model, or goes on with it, and keeps every 67th step's restart point.
Played play(const BeamModel& model, const SimulationOptions& options, const Checkpoint* from = nullptr) {
  Played played;
  long steps = 0;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& frame) { played.frames.push_back(frame); };
  observer.checkpoint_due = [&] { return ++steps % 67 == 0; };
  observer.checkpoint = [&](const Checkpoint& point) { played.points.push_back(point); };
  played.report = simulate(model, {{0, 0.9}}, options, observer, from);
  return played;
}

// What a restart point is after it has been on the disk.
Checkpoint stored(Checkpoint point) {
  const TemporaryDirectory directory;
  point.inputs = "of the test";
  write_checkpoint(directory.path() / "restart.nc", point);
  const Checkpoint read = read_checkpoint(directory.path() / "restart.nc");
  EXPECT_EQ(read.inputs, "of the test");
  return read;
}

void expect_resumes_bit_by_bit(const BeamModel& model, const SimulationOptions& options) {
  const Played whole = play(model, options);
  ASSERT_EQ(whole.report.status, SimulationStatus::done);
  ASSERT_EQ(whole.frames.size(), 21u);
  const std::size_t count = whole.points.size();
  ASSERT_GE(count, 4u);
  for (const std::size_t i : {std::size_t{0}, count / 3, 2 * count / 3, count - 1}) {
    const Checkpoint from = stored(whole.points[i]);
    const Played rest = play(model, options, &from);
    ASSERT_EQ(rest.frames.size(), whole.frames.size() - from.snapshots);
    for (std::size_t k = 0; k < rest.frames.size(); ++k)
      expect_equal(rest.frames[k], whole.frames[from.snapshots + k]);
    EXPECT_EQ(rest.report.steps, whole.report.steps);
    EXPECT_EQ(rest.report.rejected_steps, whole.report.rejected_steps);
    EXPECT_EQ(rest.report.newton_iterations, whole.report.newton_iterations);
    EXPECT_EQ(rest.report.energy_drift, whole.report.energy_drift);
    EXPECT_EQ(rest.report.integration_error, whole.report.integration_error);
    EXPECT_EQ(rest.report.peak_kinetic_energy, whole.report.peak_kinetic_energy);
    ASSERT_EQ(rest.report.events.size(), whole.report.events.size());
    for (std::size_t k = 0; k < rest.report.events.size(); ++k) {
      const RunEvent &a = rest.report.events[k], &b = whole.report.events[k];
      EXPECT_EQ(a.time, b.time);
      EXPECT_EQ(a.kind, b.kind);
      EXPECT_EQ(a.body, b.body);
      EXPECT_EQ(a.s, b.s);
      EXPECT_EQ(a.energy_after, b.energy_after);
      EXPECT_EQ(a.momentum_before, b.momentum_before);
      EXPECT_EQ(a.support_impulse, b.support_impulse);
      EXPECT_EQ(a.length_after, b.length_after);
    }
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(Restart, WithFixedStepsARunGoesOnBitByBitThroughEventsAndTheEndOfTheBeam) {
  const BeamModel model = falling_beam();
  const SimulationOptions options = options_with(GeneralizedAlpha{}, 1e-3);
  expect_resumes_bit_by_bit(model, options);
  EXPECT_GE(play(model, options).report.events.size(), 5u);
}

// On a guide that swings up on both sides, and on a beam that deforms, over kinks in time and in the mesh.
BeamModel rubbing_bodies() {
  ModelBuilder builder(2, {0, -9.81, 0});
  const int guide = builder.add_guide(
      ReferenceCurve(testing::arc_cubics({0, 0, 0}, 0.2, std::numbers::pi, 2 * std::numbers::pi, 3), 2));
  const int bar = builder.add_beam(ReferenceCurve({testing::line_cubic({0, 1, 0}, {1, 0.8, 0})}, 2),
                                   testing::round_bar(0.02, 7200, 2e7), {8});
  builder.clamp(bar, 0);
  const Friction friction{.coefficient = 0.1, .static_coefficient = 0.2};
  builder.slide(builder.add_body("on the guide", 0.5), guide, 0.02).friction = friction;
  builder.slide(builder.add_body("on the bar", 0.5), bar, 0.2).friction = friction;
  return builder.build();
}

TEST(Restart, WithFrictionARunGoesOnBitByBitWhetherBodiesStickOrSlide) {
  const BeamModel model = rubbing_bodies();
  const SimulationOptions options = options_with(GeneralizedAlpha{}, 1e-3);
  expect_resumes_bit_by_bit(model, options);
  const auto events = play(model, options).report.events;
  EXPECT_GE(std::count_if(events.begin(), events.end(),
                          [](const RunEvent& event) { return event.kind == EventKind::slides; }),
            1);
  expect_resumes_bit_by_bit(model, options_with(GeneralizedAlpha{.tolerance = 1e-4}, {}));
}

TEST(Restart, WithErrorControlARunGoesOnBitByBit) {
  expect_resumes_bit_by_bit(falling_beam(), options_with(GeneralizedAlpha{.tolerance = 1e-3}, {}));
}

TEST(Restart, WithConstantWeightsARunGoesOnBitByBit) {
  BeamModel model = falling_beam();
  model.beams[0].weights = WeightRule::constant;
  model.beams[0].merge = MergeRule::paper;
  expect_resumes_bit_by_bit(model, options_with(GeneralizedAlpha{}, 1e-3));
}

// With lengths that equilibrium gave, droppers that go slack, clamps and damping of every kind.
TEST(Restart, WithConnectorsARunGoesOnBitByBit) {
  BeamModel model = testing::one_beam({testing::line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                                      testing::round_bar(0.02, 7200, 2e6), 6, {{0, true}});
  testing::add_slider(model, 0.8, 0.2);
  model.beams[0].properties.mass_damping = 0.1;
  model.beams[0].properties.damping = model.beams[0].properties.tension_damping = 1e-3;
  const double s = model.beams[0].home.back().s;
  model.connectors = {{.name = "dropper",
                       .ends = {Grip::on_beam(0, s), Grip::at_point({s, 0.5, 0})},
                       .type = ConnectorType::tension_only,
                       .stiffness = 2000,
                       .damping = 3,
                       .length = 0.5,
                       .length_rule = ConnectorLength::as_drawn}};
  model.forces.push_back(PlaceMass{.beam = 0, .s = s, .mass = 0.3});
  SimulationOptions options = options_with(GeneralizedAlpha{}, 1e-3);
  options.start_from_equilibrium = true;
  model.riders[0].speed = 0.5;
  expect_resumes_bit_by_bit(model, options);
}

TEST(Restart, WithRungeAndKuttaARunGoesOnBitByBit) {
  BeamModel model = testing::one_beam({testing::line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                                      testing::round_bar(0.02, 7200, 2e6), 4, {{0, false}});
  expect_resumes_bit_by_bit(model, options_with(ExplicitRungeKutta{}, 1e-3));
}

TEST(Restart, WithRadauARunGoesOnBitByBitThroughChangesOfTheMesh) {
  expect_resumes_bit_by_bit(falling_beam(), options_with(Radau{}, 1e-3));
  SimulationOptions adaptive = options_with(Radau{.tolerance = 1e-3}, 1e-3);
  adaptive.step.reset();
  expect_resumes_bit_by_bit(falling_beam(), adaptive);
}

TEST(Restart, WithARigidCornerARunGoesOnBitByBit) {
  BeamModel model = testing::one_beam(
      {testing::line_cubic({0, 0, 0}, {0, 1, 0}), testing::line_cubic({0, 1, 0}, {0.7, 1, 0})}, 2,
      testing::round_bar(0.02, 7200, 2e6), 6, {{0, true}});
  std::vector<HomeNode>& home = model.beams[0].home;
  std::find_if(home.begin() + 1, home.end(), [](const HomeNode& node) { return node.permanent; })->kind =
      NodeKind::rigid;
  expect_resumes_bit_by_bit(model, options_with(GeneralizedAlpha{}, 1e-3));
}

TEST(Restart, WhatIsToBeWarnedOfIsKept) {
  Checkpoint point = play(falling_beam(), options_with(GeneralizedAlpha{}, 1e-3)).points.front();
  EXPECT_FALSE(stored(point).report.diverges);
  EXPECT_FALSE(stored(point).report.snap);
  point.report.diverges = true;
  point.report.snap = {.load = 0.5, .t = 0};
  point.said_of_files = {"solid.step", "not written", "other.step", "not written either"};
  point.peaks = {2, 1, 1, 0.5, 0, 0};
  point.report.points_for_good = {{0, 0.25, 0.125, 3}};
  point.plan.points_for_good = {true};
  EXPECT_TRUE(stored(point).plan.is_point_for_good(0));
  ASSERT_EQ(stored(point).report.points_for_good.size(), 1u);
  EXPECT_EQ(stored(point).report.points_for_good[0].energy, 3);
  point.extremes = {3.5, 0.25, 1e-3, -2, 0, 0.5};
  const Checkpoint read = stored(point);
  EXPECT_TRUE(read.report.diverges);
  ASSERT_TRUE(read.report.snap);
  EXPECT_EQ(read.report.snap->load, 0.5);
  EXPECT_EQ(read.report.snap->t, 0);
  EXPECT_EQ(read.said_of_files, point.said_of_files);
  EXPECT_EQ(read.peaks, point.peaks);
  EXPECT_EQ(read.extremes, point.extremes);
}

TEST(Restart, APointThatIsCutShortOrOfAnotherKindIsNamed) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "restart.nc";
  const auto expect_named = [&] {
    try {
      read_checkpoint(file);
      ADD_FAILURE();
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
    }
  };
  expect_named();  // there is none
  std::ofstream(file) << "not netCDF";
  expect_named();
  const Played played = play(falling_beam(), options_with(GeneralizedAlpha{}, 1e-3));
  Checkpoint point = played.points.front();
  point.inputs = "x";
  write_checkpoint(file, point);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  expect_named();
}

}  // namespace
}  // namespace nurbeam
