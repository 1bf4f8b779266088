#pragma once
#include <utility>
#include <vector>

#include "pipelines/accuracy/level_numbers.h"
#include "pipelines/model/features.h"

namespace nurbeam::verification {

/// The features of all models and analyses noted on this thread since the last call.
Features take_noted();

void note(const Features& features);

/// The model at the thread's level, whose features are noted; for those that a problem computes with. Throws
/// std::runtime_error where its elements are too few for the level.
BeamModel noted(const BeamModel& model);
/// The same with the options of its analysis.
template <class Options>
BeamModel noted(const BeamModel& model, const Options& options) {
  note(features_of(options));
  return noted(model);
}

/// What problems of a thread are computed with: 2^level times the elements of their models, and steps of a
/// 2^level-th; 0 is as they are. What their runs have come to is kept, where that is asked for.
struct ProblemLevel {
  int level = 0;
  bool keeps_numbers = false;
  int fewest_elements = 0;  ///< of a beam of a model that was noted
  bool moves = false;       ///< whether there was a motion
  std::vector<LevelNumbers> numbers = {};
};
ProblemLevel& problem_level();

/// The options at the thread's level.
SimulationOptions at_problem_level(SimulationOptions options);
/// Keeps the numbers of a run, by its frames.
void keep_numbers(const std::vector<Snapshot>& frames, const SimulationReport& report);

inline const SimulationOptions as_statics{.statics = true};

}  // namespace nurbeam::verification
