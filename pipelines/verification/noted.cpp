#include "pipelines/verification/noted.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "pipelines/run/level_model.h"

namespace nurbeam::verification {

namespace {

// A problem runs on one thread.
thread_local Features found;

}  // namespace

Features take_noted() { return std::exchange(found, {}); }

void note(const Features& features) { found.insert(features.begin(), features.end()); }

ProblemLevel& problem_level() {
  thread_local ProblemLevel level;
  return level;
}

BeamModel noted(const BeamModel& model) {
  note(features_of(model));
  ProblemLevel& at = problem_level();
  std::optional<BeamModel> made = model_at_level(model, at.level);
  if (!made)
    throw std::runtime_error("there are too few elements for 2^" + std::to_string(at.level) +
                             " times as many");
  for (const Beam& beam : made->beams)
    if (!beam.rigid && (at.fewest_elements == 0 || beam.home_intervals() < at.fewest_elements))
      at.fewest_elements = beam.home_intervals();
  return std::move(*made);
}

SimulationOptions at_problem_level(SimulationOptions options) {
  ProblemLevel& at = problem_level();
  at.moves = at.moves || !options.statics;
  if (options.step) *options.step *= std::exp2(-at.level);
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
  const Snapshot& first = frames.front();
  LevelRecorder recorder({.probes = numbered(first.probes.size(), "probe"),
                          .bodies = numbered(first.bodies.size(), "body"),
                          .beams = numbered(first.beams.size(), "beam"),
                          .reactions = numbered(first.reactions.size(), "reaction"),
                          .connectors = numbered(first.connectors.size(), "connector"),
                          .measures = {}});
  for (Snapshot frame : frames) {
    frame.measures.clear();
    recorder.look_at(frame);
  }
  at.numbers.push_back(recorder.numbers(report));
}

}  // namespace nurbeam::verification
