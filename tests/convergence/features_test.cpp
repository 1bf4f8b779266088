// What happens in the middle of friction, stops, connectors, tension and damping changes none of them: a
// restart, bit by bit, and a change of the mesh.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "fem/forces/memory.h"
#include "fem/mesh/stop_distance.h"
#include "fem/motion/remesh/meshed_state.h"
#include "fem/motion/run/simulation.h"
#include "fem/system/observables.h"
#include "pipelines/results/restart_file.h"
#include "pipelines/verification/feature_models.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam {

namespace verification {

// What a failed test prints of its parameter.
void PrintTo(const FeatureModel& feature, std::ostream* stream) { *stream << feature.name; }

}  // namespace verification

namespace {

using verification::FeatureModel;

SimulationOptions options_of(const FeatureModel& feature) {
  SimulationOptions options;
  options.end_time = feature.end;
  options.step = feature.step;
  for (int i = 0; i <= 10; ++i) options.output_times.push_back(i * feature.end / 10);
  return options;
}

class FeaturesOfARun : public ::testing::TestWithParam<FeatureModel> {};

struct EndOfRun {
  State state;
  SimulationReport report;
  Snapshot last;
};

EndOfRun run_to_the_end(const std::shared_ptr<const BeamModel>& model, const SimulationOptions& options,
                        const SimulationObserver& observer, const Checkpoint* from = nullptr) {
  Simulation simulation(model, {}, options, observer, from);
  while (simulation.advance()) {
  }
  return {simulation.state(), simulation.report(), simulation.present()};
}

TEST_P(FeaturesOfARun, GoOnFromARestartFileBitByBit) {
  const auto model = std::make_shared<const BeamModel>(GetParam().model);
  const SimulationOptions options = options_of(GetParam());
  std::vector<Checkpoint> points;
  const test::TemporaryDirectory directory;
  const long apart = std::lround(options.end_time / *options.step) / 12;
  long steps = 0;
  std::vector<bool> closed;
  SimulationObserver observer;
  // Now and then, and whenever a stop has closed or opened.
  observer.checkpoint_due = [&] { return true; };
  observer.checkpoint = [&](const Checkpoint& point) {
    const bool at_times = steps++ % apart == 0;
    if (at_times || closed != point.plan.closed) points.push_back(point);
    closed = point.plan.closed;
  };
  const EndOfRun whole = run_to_the_end(model, options, observer);
  ASSERT_EQ(whole.report.status, SimulationStatus::done);
  ASSERT_GE(points.size(), 10u);
  for (const Checkpoint& point : points) {
    const auto file = directory.path() / "restart.nc";
    write_checkpoint(file, point);
    const Checkpoint read = read_checkpoint(file);
    const EndOfRun rest = run_to_the_end(model, options, {}, &read);
    ASSERT_EQ(rest.report.status, SimulationStatus::done) << point.state.t;
    EXPECT_TRUE(rest.state.q == whole.state.q && rest.state.v == whole.state.v &&
                rest.state.lambda == whole.state.lambda && rest.state.memory == whole.state.memory)
        << point.state.t;
    EXPECT_EQ(rest.last.energy.total, whole.last.energy.total) << point.state.t;
    EXPECT_EQ(rest.last.energy.dissipated, whole.last.energy.dissipated) << point.state.t;
    EXPECT_EQ(rest.report.events.size(), whole.report.events.size()) << point.state.t;
  }
}

// What bodies, stops and connectors are at a moment, whatever the mesh; forces that follow from accelerations
// are not among it, which a finer mesh has its own of.
std::vector<double> acting(const BeamSystem& system, const State& state) {
  const BeamModel& model = system.model();
  std::vector<double> now;
  for (int i = 0; i < static_cast<int>(model.connectors.size()); ++i) {
    const auto [length, force] = length_and_force(system, state, i);
    now.push_back(length);
    if (model.connectors[i].type != ConnectorType::rod) now.push_back(force);
  }
  for (int i = 0; i < static_cast<int>(model.stops.size()); ++i) {
    now.push_back(StopDistance(model, system.mesh(), model.stops[i]).value(state.q));
    now.push_back(system.mesh().plan.is_closed(i));
  }
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j)
    if (const std::optional<double> s = place(system, state, j)) {
      now.push_back(*s);
      // The waves of an impact are shorter than elements: without a node their mean is its velocity.
      if (model.stops.empty()) now.push_back(place_rate(system, state, j));
    }
  return now;
}

void expect_same(const std::vector<double>& before, const std::vector<double>& after, double tolerance,
                 double time) {
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(after[i], before[i], tolerance * std::max(1.0, std::abs(before[i])))
        << i << " at " << time << " s";
}

// Elements are split and merged beside the bodies at every tenth step as length control would at other
// lengths.
TEST_P(FeaturesOfARun, AreTheSameOnAnotherMesh) {
  const auto model = std::make_shared<const BeamModel>(GetParam().model);
  const SimulationOptions options = options_of(GetParam());
  if (model->riders.empty() || model->riders[0].as_point || model->beam_of(model->riders[0]).rigid)
    GTEST_SKIP() << "no mesh changes";
  Simulation simulation(model, {}, options);
  int changes = 0;
  for (long i = 0; simulation.advance(); ++i) {
    if (i % 10 != 5) continue;
    for (const LengthControl& control : {LengthControl{0.05, 0.6}, LengthControl{0.4, 1.9}}) {
      const NextPlan next = next_plan(simulation.system(), simulation.state(), control);
      if (next.change == MeshChange::none) continue;
      MeshedState at{
          std::make_unique<BeamSystem>(model, present_plan(simulation.system(), simulation.state())),
          simulation.state()};
      ASSERT_FALSE(change_mesh(at, next, false));
      ++changes;
      EXPECT_EQ(at.state.memory, simulation.state().memory);
      // Velocities are projected where a node goes or comes on a curve.
      expect_same(acting(simulation.system(), simulation.state()), acting(*at.system, at.state), 2e-3,
                  at.state.t);
    }
  }
  EXPECT_EQ(simulation.report().status, SimulationStatus::done);
  const double slid = std::abs(*place(simulation.system(), simulation.state(), 0) - model->riders[0].s);
  EXPECT_GE(changes, slid > 0.2 ? 3 : 0);
}

INSTANTIATE_TEST_SUITE_P(Each, FeaturesOfARun, ::testing::ValuesIn(verification::feature_models()),
                         [](const auto& info) {
                           std::string name = info.param.name;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace nurbeam
