#include "fem/motion/run/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "fem/model/build.h"
#include "nurbs/primitives.h"

namespace nurbeam {
namespace {

// A cantilever that a force at its end sets swinging.
std::shared_ptr<const BeamModel> swinging_cantilever() {
  ModelBuilder builder(2);
  const ReferenceCurve line({line_cubic({0, 0, 0}, {1, 0, 0})}, 2);
  builder.add_beam(line, BeamProperties(1e5, 2, 1), {.elements = 4});
  builder.clamp(0, 0).force(0, 1, {0, -0.5, 0});
  return std::make_shared<const BeamModel>(builder.build());
}

SimulationOptions twenty_steps() {
  SimulationOptions options;
  options.end_time = 0.2;
  options.step = 0.01;
  options.output_times = {0, 0.1, 0.2};
  return options;
}

TEST(SimulationTest, StepByStepItIsTheRunAtOnce) {
  std::vector<Snapshot> at_once, by_steps;
  SimulationObserver first, second;
  first.snapshot = [&](const Snapshot& s) { at_once.push_back(s); };
  second.snapshot = [&](const Snapshot& s) { by_steps.push_back(s); };
  const SimulationReport whole = simulate(swinging_cantilever(), {}, twenty_steps(), first);
  Simulation simulation(swinging_cantilever(), {}, twenty_steps(), second);
  int calls = 1;
  while (simulation.advance()) ++calls;
  EXPECT_EQ(calls, 21);  // the start and every step
  EXPECT_FALSE(simulation.advance());
  EXPECT_EQ(whole.steps, simulation.report().steps);
  ASSERT_EQ(at_once.size(), by_steps.size());
  for (std::size_t i = 0; i < at_once.size(); ++i) {
    EXPECT_EQ(at_once[i].time, by_steps[i].time);
    EXPECT_EQ(at_once[i].beams[0].node_positions, by_steps[i].beams[0].node_positions);
    EXPECT_EQ(at_once[i].energy.total, by_steps[i].energy.total);
  }
}

// Of a cantilever that swings a few times between its first and its last snapshot.
struct Peaks {
  std::vector<double> times, energies;
  SimulationObserver observer() {
    SimulationObserver observer;
    observer.peak = [this](const Snapshot& s) {
      times.push_back(s.time);
      energies.push_back(s.energy.bending);
      EXPECT_TRUE(s.beams[0].elements.empty());
    };
    return observer;
  }
};

SimulationOptions three_hundred_steps() {
  SimulationOptions options = twenty_steps();
  options.end_time = 3;
  options.output_times = {0, 3};
  return options;
}

TEST(SimulationTest, TheLargestOfAllStepsIsShown) {
  Peaks peaks;
  double largest = 0, when = 0;
  Simulation simulation(swinging_cantilever(), {}, three_hundred_steps(), peaks.observer());
  while (simulation.advance())
    if (const Snapshot now = simulation.present({.energy = true}); now.energy.bending > largest)
      std::tie(largest, when) = std::pair(now.energy.bending, now.time);
  ASSERT_FALSE(peaks.times.empty());
  EXPECT_LT(peaks.times.size(), 10u) << "each takes longer than a step";
  const auto best = std::ranges::max_element(peaks.energies);
  EXPECT_NEAR(*best, largest, 1e-3 * largest);
  EXPECT_NEAR(peaks.times[best - peaks.energies.begin()], when, 0.03);
}

TEST(SimulationTest, PeaksAreTheSameWhereverARunIsInterrupted) {
  Peaks whole;
  simulate(swinging_cantilever(), {}, three_hundred_steps(), whole.observer());
  for (const int steps : {3, 40, 111, 250}) {
    Peaks former, later;
    Simulation first(swinging_cantilever(), {}, three_hundred_steps(), former.observer());
    for (int i = 0; i < steps; ++i) first.advance();
    const Checkpoint point = first.checkpoint();
    Simulation second(swinging_cantilever(), {}, three_hundred_steps(), later.observer(), &point);
    while (second.advance()) {
    }
    former.times.insert(former.times.end(), later.times.begin(), later.times.end());
    former.energies.insert(former.energies.end(), later.energies.begin(), later.energies.end());
    EXPECT_EQ(former.times, whole.times) << steps;
    EXPECT_EQ(former.energies, whole.energies) << steps;
  }
}

TEST(SimulationTest, LookingAtPeaksOnTheWayChangesNone) {
  Peaks whole, looked_at;
  simulate(swinging_cantilever(), {}, three_hundred_steps(), whole.observer());
  Simulation simulation(swinging_cantilever(), {}, three_hundred_steps(), looked_at.observer());
  std::size_t seen = 0;
  while (simulation.advance()) seen = std::max(seen, simulation.peaks().size());
  EXPECT_GT(seen, 0u);
  EXPECT_EQ(looked_at.times, whole.times);
}

TEST(SimulationTest, SnapshotsHoldNoMoreThanIsAskedFor) {
  const std::vector<ProbePlace> middle{{.beam = 0, .s = 0.5}};
  const auto last = [&](const SnapshotContents& contents) {
    Snapshot found;
    SimulationObserver observer;
    observer.snapshot = [&](const Snapshot& s) { found = s; };
    observer.contents = contents;
    simulate(swinging_cantilever(), middle, twenty_steps(), observer);
    return found;
  };
  const Snapshot all = last({});
  const Snapshot place = last({.beams = false, .sections = false, .reactions = false, .energy = false});
  EXPECT_TRUE(place.beams.empty());
  EXPECT_TRUE(place.reactions.empty());
  EXPECT_EQ(place.probes.at(0).position, all.probes.at(0).position);
  EXPECT_NE(all.probes[0].section.bending_moment, 0);
  EXPECT_EQ(place.probes[0].section.bending_moment, 0);
  EXPECT_EQ(place.energy.total, all.energy.total);  // what a motion is judged by
  const Snapshot reactions = last({.beams = false, .probes = false, .energy = false});
  EXPECT_TRUE(reactions.probes.empty());
  EXPECT_EQ(reactions.reactions.at(0).force, all.reactions.at(0).force);
}

TEST(SimulationTest, ACheckpointGoesOnAsIfThereHadBeenNone) {
  Simulation whole(swinging_cantilever(), {}, twenty_steps());
  EXPECT_THROW(whole.checkpoint(), std::invalid_argument);
  while (whole.state().t < 0.1) whole.advance();
  const Checkpoint point = whole.checkpoint();
  Simulation rest(swinging_cantilever(), {}, twenty_steps(), {}, &point);
  while (whole.advance()) {
  }
  while (rest.advance()) {
  }
  EXPECT_EQ(whole.state().q, rest.state().q);
  EXPECT_EQ(whole.state().v, rest.state().v);
}

TEST(SimulationTest, ChangedForcesActFromThenOnAndNoEnergyComesOfIt) {
  SimulationOptions fine = twenty_steps();  // a force that begins and ends at once excites all that swings
  fine.step = 0.001;
  Simulation simulation(swinging_cantilever(), {}, fine);
  while (simulation.state().t < 0.1) simulation.advance();
  const double before = simulation.state().q.norm();
  EXPECT_TRUE(simulation.change_forces([](std::vector<Force>& forces) { forces.clear(); }));
  EXPECT_EQ(simulation.state().q.norm(), before);
  while (simulation.advance()) {
  }
  EXPECT_TRUE(simulation.system().model().forces.empty());
  EXPECT_LT(simulation.report().energy_drift, 1e-3 * simulation.report().energy_scale());
}

TEST(SimulationTest, ChangedForcesLeaveBodiesHeldAtRest) {
  ModelBuilder builder(2, {0, -10, 0});
  const ReferenceCurve line({line_cubic({0, 0, 0}, {1, 0, 0})}, 2);
  builder.add_beam(line, BeamProperties(1e5, 2, 1), {.elements = 4});
  builder.clamp(0, 0).clamp(0, 1);
  builder.slide(builder.add_body("bead", 1), 0, 0.3).rest = StaticPlace::held;
  SimulationOptions statics;
  statics.statics = true;
  statics.output_times = {1, 2};
  Simulation simulation(std::make_shared<const BeamModel>(builder.build()), {}, statics);
  simulation.advance();
  const double before = simulation.present().bodies.at(0).holding_force;
  simulation.change_forces([](std::vector<Force>&) {});
  EXPECT_EQ(simulation.system().held(), std::vector<bool>{true});
  EXPECT_EQ(simulation.state().lambda.size(), simulation.system().constraint_count());
  EXPECT_GT(std::abs(before), 1e-3);
  EXPECT_NEAR(simulation.present().bodies.at(0).holding_force, before, 1e-9 * std::abs(before));
}

TEST(SimulationTest, WhatAForceThrowsArrivesAndTheMotionGoesOnFromItsLastStep) {
  struct Refusal {};
  auto model = std::make_shared<BeamModel>(*swinging_cantilever());
  auto refuses = std::make_shared<bool>(false);
  model->forces.push_back(CustomForce{
      {Grip::on_beam(0, 1)}, [refuses](double, const Eigen::Matrix3Xd& r, const Eigen::Matrix3Xd&) {
        if (*refuses) throw Refusal{};
        return CustomForce::Response{Eigen::Matrix3Xd::Zero(3, r.cols()), {}, {}};
      }});
  Simulation simulation(model, {}, twenty_steps());
  while (simulation.state().t < 0.1) simulation.advance();
  *refuses = true;
  const State before = simulation.state();
  EXPECT_THROW(simulation.advance(), Refusal);
  EXPECT_EQ(simulation.state().t, before.t);
  EXPECT_EQ(simulation.state().q, before.q);
  *refuses = false;
  while (simulation.advance()) {
  }
  EXPECT_EQ(simulation.report().status, SimulationStatus::done);
}

// An observer that interrupts at a question, which are counted.
SimulationObserver interrupting(int& questions, int at) {
  SimulationObserver observer;
  observer.interrupted = [&questions, at] { return ++questions == at; };
  return observer;
}

TEST(SimulationTest, AnInterruptionEndsASearchForRestAtItsNextIteration) {
  for (const bool statics : {true, false}) {
    SimulationOptions options = twenty_steps();
    options.statics = statics;
    options.start_from_equilibrium = true;
    int questions = 0;
    simulate(swinging_cantilever(), {}, options, interrupting(questions, -1));
    ASSERT_GT(questions, 5);
    questions = 0;
    Simulation simulation(swinging_cantilever(), {}, options, interrupting(questions, 3));
    EXPECT_FALSE(simulation.advance());
    EXPECT_FALSE(simulation.advance());
    EXPECT_EQ(questions, 3);
    EXPECT_EQ(simulation.report().status, SimulationStatus::interrupted);
  }
}

TEST(SimulationTest, StepsAreThoseOfTheMotionOrWhereThereIsNoneOfTheLoads) {
  SimulationOptions options = twenty_steps();
  options.start_from_equilibrium = true;
  EXPECT_EQ(simulate(swinging_cantilever(), {}, options, {}).steps, 20);
  options.statics = true;
  EXPECT_GT(simulate(swinging_cantilever(), {}, options, {}).steps, 0);
}

TEST(SimulationTest, WhatAForceThrowsEndsASearchForRest) {
  struct Refusal {};
  auto model = std::make_shared<BeamModel>(*swinging_cantilever());
  model->forces.push_back(
      CustomForce{{Grip::on_beam(0, 1)},
                  [](double, const Eigen::Matrix3Xd&, const Eigen::Matrix3Xd&) -> CustomForce::Response {
                    throw Refusal{};
                  }});
  SimulationOptions options = twenty_steps();
  options.start_from_equilibrium = true;
  Simulation simulation(model, {}, options);
  EXPECT_THROW(simulation.advance(), Refusal);
  EXPECT_FALSE(simulation.advance());
  EXPECT_EQ(simulation.report().status, SimulationStatus::interrupted);
}

}  // namespace
}  // namespace nurbeam
