#include "pipelines/run/level_run.h"

#include <cmath>
#include <memory>

#include "pipelines/model/model_snapshot.h"
#include "pipelines/run/level_model.h"
#include "pipelines/run/mode_run.h"
#include "pipelines/run/simulation_plan.h"

namespace nurbeam {

namespace {

LevelNumbers motion_or_rest(const CaseFile& c, const BuiltModel& built, int level, LevelSteps& steps,
                            const std::function<bool()>& interrupted) {
  LevelRecorder recorder(snapshot_names(built));
  SimulationObserver observer;
  observer.interrupted = interrupted;
  observer.snapshot = [&](Snapshot frame) { recorder.look_at(to_world(built.frame, std::move(frame))); };
  observer.peak = [&](Snapshot moment) { recorder.look_between(to_world(built.frame, std::move(moment))); };
  const std::shared_ptr<const BeamModel> model(std::shared_ptr<void>(), &built.model);
  const SimulationOptions options = options_at_level(c, level, steps);
  LevelNumbers numbers = recorder.numbers(simulate(model, probe_places(built), options, observer));
  numbers.step = options.step;
  return numbers;
}

}  // namespace

std::vector<int> levels_of_errors(const CaseFile& case_file, const BuiltModel& built, LevelSteps& steps) {
  const bool has_half = at_level(built, -1).has_value();
  if (case_file.analysis.type == CaseAnalysis::Type::dynamic)
    return {has_half && (case_file.analysis.step || steps.has_pairs()) ? -1 : 1};
  if (has_half && at_level(built, -2)) return {-1, -2};
  return has_half ? std::vector{1, -1} : std::vector{1, 2};
}

SimulationOptions options_at_level(const CaseFile& case_file, int level, LevelSteps& steps) {
  SimulationOptions options = simulation_options(case_file);
  if (options.statics) return options;
  if (options.step) {
    *options.step *= std::exp2(-level);
    return options;
  }
  std::visit([](auto& method) { method.tolerance = 0; }, options.integrator);
  options.given_step = [&steps, level](double time) { return steps.at(time, level); };
  return options;
}

std::vector<double> numbers_of_modes(const ModeTable& table) {
  std::vector<double> numbers;
  for (const ModeRow& row : table.rows) numbers.push_back(table.buckling ? row.factor : row.frequency());
  return numbers;
}

LevelNumbers run_level(const CaseFile& case_file, const BuiltModel& at_level, int level, LevelSteps& steps,
                       const std::function<bool()>& interrupted) {
  LevelNumbers numbers;
  if (case_file.analysis.has_modes()) {
    ModeTable table;
    const SimulationReport report =
        run_modes(case_file, at_level, interrupted,
                  {.state = [](const Snapshot&) {},
                   .shape = [](const Snapshot&) {},
                   .turn = [](const std::string&, const std::vector<Snapshot>&) {}},
                  table);
    numbers = LevelRecorder({}).numbers(report);
    numbers.modes = numbers_of_modes(table);
  } else {
    numbers = motion_or_rest(case_file, at_level, level, steps, interrupted);
  }
  numbers.level = level;
  numbers.elements = element_count(at_level.model);
  return numbers;
}

}  // namespace nurbeam
