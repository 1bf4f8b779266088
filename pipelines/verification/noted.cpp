#include "pipelines/verification/noted.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "pipelines/run/level_model.h"

namespace nurbeam::verification {

namespace {

// A problem runs on one thread.
thread_local Features found;

bool is_smooth_force(const HomeNode& node) {
  return node.kind == NodeKind::smooth && !node.sharp && (node.kept || node.hold != Hold::nothing);
}

bool has_smooth_forces(const BeamModel& model) {
  const auto is_smooth_inside = [&](const Rider& rider) {
    const Beam& beam = model.beams[rider.beam];
    return !beam.rigid && rider.continuous_slope && !rider.reel && rider.s > 0 &&
           rider.s < beam.curve.length();
  };
  const auto is_load_inside = [&](const Force& force) {
    const auto* load = std::get_if<PointLoad>(&force);
    if (!load) return false;
    const Beam& beam = model.beams[load->beam];
    return !beam.rigid && load->s > 0 && load->s < beam.curve.length();
  };
  return std::ranges::any_of(model.riders, is_smooth_inside) ||
         std::ranges::any_of(model.forces, is_load_inside) ||
         std::ranges::any_of(model.beams, [](const Beam& beam) {
           return !beam.rigid && beam.home.size() > 2 &&
                  std::any_of(beam.home.begin() + 1, beam.home.end() - 1, is_smooth_force);
         });
}

}  // namespace

Features take_noted() { return std::exchange(found, {}); }

void note(const Features& features) { found.insert(features.begin(), features.end()); }

ProblemLevel& problem_level() {
  thread_local ProblemLevel level;
  return level;
}

BeamModel noted(const BeamModel& model) {
  problem_level().by_hand = true;
  return noted_for_run(model);
}

BeamModel noted_for_run(const BeamModel& model) {
  note(features_of(model));
  ProblemLevel& at = problem_level();
  std::optional<BeamModel> made = model_at_level(model, at.level);
  if (!made)
    throw std::runtime_error("there are too few elements for 2^" + std::to_string(at.level) +
                             " times as many");
  for (const Beam& beam : made->beams)
    if (!beam.rigid && (at.fewest_elements == 0 || beam.home_intervals() < at.fewest_elements))
      at.fewest_elements = beam.home_intervals();
  at.has_jumps = at.has_jumps || has_smooth_forces(*made);
  return std::move(*made);
}

SimulationOptions at_problem_level(SimulationOptions options) {
  ProblemLevel& at = problem_level();
  if (options.statics) return options;
  at.moves = true;
  if (options.step) {
    *options.step *= std::exp2(-at.level);
  } else if (at.given) {
    if (at.steps.size() >= at.given->size()) throw std::runtime_error("there are more runs than before");
    const std::shared_ptr<LevelSteps> steps = (*at.given)[at.steps.size()];
    std::visit([](auto& method) { method.tolerance = 0; }, options.integrator);
    options.given_step = [steps, beside = at.beside](double time) { return steps->at(time, beside); };
  }
  if (!options.step) at.steps.push_back(std::make_shared<LevelSteps>(options.output_times));
  return options;
}

namespace {

std::vector<std::string> numbered(std::size_t count, const std::string& what) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back(what + std::to_string(i));
  return names;
}

}  // namespace

void keep_numbers(const std::vector<Snapshot>& frames, const SimulationReport& report) {
  ProblemLevel& at = problem_level();
  if (!at.keeps_numbers || frames.empty()) return;
  if (!at.steps.empty()) {
    for (const Snapshot& frame : frames)
      for (const StepRecord& step : frame.steps) at.steps.back()->add(step);
    at.steps.back()->end();
  }
  const Snapshot& first = frames.front();
  const SnapshotNames names{.probes = numbered(first.probes.size(), "probe"),
                            .bodies = numbered(first.bodies.size(), "body"),
                            .beams = numbered(first.beams.size(), "beam"),
                            .reactions = numbered(first.reactions.size(), "reaction"),
                            .connectors = numbered(first.connectors.size(), "connector"),
                            .measures = {}};
  LevelRecorder recorder(names);
  for (Snapshot frame : frames) {
    frame.measures.clear();
    recorder.look_at(frame);
  }
  at.runs.push_back({recorder.numbers(report), history_quantities(history_columns(names))});
}

}  // namespace nurbeam::verification
