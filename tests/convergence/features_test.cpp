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
#include "fem/motion/meshed_state.h"
#include "fem/motion/simulation.h"
#include "fem/system/observables.h"
#include "pipelines/results/restart_file.h"
#include "pipelines/verification/feature_models.h"
#include "solver/consistent.h"
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

class Features : public ::testing::TestWithParam<FeatureModel> {};

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

TEST_P(Features, GoOnFromARestartFileBitByBit) {
  const auto model = std::make_shared<const BeamModel>(GetParam().model);
  const SimulationOptions options = options_of(GetParam());
  std::vector<Checkpoint> points;
  const test::TemporaryDirectory directory;
  const long apart = std::lround(options.end_time / *options.step) / 12;
  long steps = 0;
  Eigen::VectorXd memory;
  std::vector<bool> closed;
  SimulationObserver observer;
  // Now and then, and whenever something has begun to stick, to press or to pull.
  observer.checkpoint_due = [&] { return true; };
  observer.checkpoint = [&](const Checkpoint& point) {
    const bool begun = steps == 0 || closed != point.plan.closed;
    if (begun || ++steps % apart == 1) points.push_back(point);
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

// What bodies, stops and connectors are and do at a moment.
struct Acting {
  std::vector<double> exact;   // what is the same on any mesh
  std::vector<double> forces;  // what is where the shape is
};

std::optional<Acting> acting(const BeamSystem& system, const State& at) {
  State state = at;
  if (make_accelerations_consistent(system, state) != ConsistencyStatus::done) return {};
  Acting now;
  const BeamModel& model = system.model();
  now.exact.assign(state.memory.begin(), state.memory.end());
  for (int i = 0; i < static_cast<int>(model.connectors.size()); ++i) {
    const auto [length, force] = length_and_force(system, state, i);
    now.exact.push_back(length);
    (model.connectors[i].type == ConnectorType::rod ? now.forces : now.exact).push_back(force);
  }
  for (int i = 0; i < static_cast<int>(model.stops.size()); ++i) {
    now.exact.push_back(stop_distance(system.mesh(), model.stops[i], state.q));
    now.exact.push_back(system.mesh().plan.is_closed(i));
    now.forces.push_back(contact_force(system, state, i));
  }
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
    const std::optional<double> s = place(system, state, j);
    if (!s) continue;
    now.exact.insert(now.exact.end(), {*s, place_rate(system, state, j)});
    const Eigen::Vector3d force = joint_force(system, state, j);
    now.forces.insert(now.forces.end(), force.begin(), force.end());
    if (const auto friction = sliding_friction(system, state, j))
      now.forces.insert(now.forces.end(), {friction->along, friction->bound});
  }
  return now;
}

void expect_same(const std::vector<double>& before, const std::vector<double>& after, double tolerance,
                 const char* what, double time) {
  ASSERT_EQ(before.size(), after.size()) << what;
  double scale = 1;
  for (const double value : before) scale = std::max(scale, std::abs(value));
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(after[i], before[i], tolerance * scale) << what << " " << i << " at " << time << " s";
}

// Elements are split and merged beside the bodies at every tenth step as length control would at other
// lengths.
TEST_P(Features, AreTheSameOnAnotherMesh) {
  const auto model = std::make_shared<const BeamModel>(GetParam().model);
  const SimulationOptions options = options_of(GetParam());
  if (model->joints.empty() || model->beam_of(model->joints[0]).rigid) GTEST_SKIP() << "no mesh changes";
  Simulation simulation(model, {}, options);
  int splits = 0, merges = 0;
  for (long i = 0; simulation.advance(); ++i) {
    if (i % 10 != 5) continue;
    for (const LengthControl& control : {LengthControl{0.05, 0.6}, LengthControl{0.9, 1.9}}) {
      const NextPlan next = next_plan(simulation.system(), simulation.state(), control);
      if (next.change == MeshChange::none) continue;
      const std::optional<Acting> before = acting(simulation.system(), simulation.state());
      MeshedState at{
          std::make_unique<BeamSystem>(model, present_plan(simulation.system(), simulation.state())),
          simulation.state()};
      ASSERT_FALSE(change_mesh(at, next, false).failure);
      const std::optional<Acting> after = acting(*at.system, at.state);
      ASSERT_TRUE(before && after);
      const bool merge = next.change == MeshChange::merge;
      ++(merge ? merges : splits);
      expect_same(before->exact, after->exact, merge ? 1e-6 : 1e-9, "exact", at.state.t);
      expect_same(before->forces, after->forces, merge ? 0.5 : 1e-7, merge ? "merge" : "split", at.state.t);
    }
  }
  EXPECT_EQ(simulation.report().status, SimulationStatus::done);
  EXPECT_GE(splits, 3);
  EXPECT_GE(merges, 3);
}

INSTANTIATE_TEST_SUITE_P(Each, Features, ::testing::ValuesIn(verification::feature_models()),
                         [](const auto& info) {
                           std::string name = info.param.name;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace nurbeam
