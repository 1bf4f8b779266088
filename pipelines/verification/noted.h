#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "pipelines/accuracy/level_numbers.h"
#include "pipelines/accuracy/quantities.h"
#include "pipelines/model/features.h"
#include "pipelines/run/level_steps.h"

namespace nurbeam::verification {

/// The features of all models and analyses noted on this thread since the last call.
Features take_noted();

void note(const Features& features);

/// The model at the thread's level, whose features are noted; for those that a problem computes with by its
/// own steps or matrices. Throws std::runtime_error where its elements are too few for the level.
BeamModel noted(const BeamModel& model);
/// The same of a model that is run as its options say.
BeamModel noted_for_run(const BeamModel& model);
/// The same with the options of its analysis.
template <class Options>
BeamModel noted(const BeamModel& model, const Options& options) {
  note(features_of(options));
  return noted_for_run(model);
}

/// The steps of a problem's runs under error control, in the order of the runs.
using StepsOfRuns = std::vector<std::shared_ptr<LevelSteps>>;

/// What problems of a thread are computed with: 2^level times the elements of their models, and steps of a
/// 2^level-th; 0 is as they are. What their runs have come to is kept, where that is asked for.
struct ProblemLevel {
  int level = 0;
  bool keeps_numbers = false;
  /// Where there are: runs without fixed steps take those of other runs at a level beside theirs.
  const StepsOfRuns* given = nullptr;
  int beside = 0;

  int fewest_elements = 0;  ///< of a beam of a model that was noted
  bool moves = false;       ///< whether there was a motion
  bool by_hand = false;     ///< whether a model was computed with otherwise than by a run
  bool has_jumps = false;   ///< whether elements are smooth across a force inside a beam
  StepsOfRuns steps = {};
  struct Kept {
    LevelNumbers numbers;
    std::vector<HistoryQuantity> quantities;
  };
  std::vector<Kept> runs = {};
};
ProblemLevel& problem_level();

/// The options at the thread's level.
SimulationOptions at_problem_level(SimulationOptions options);
/// Keeps the numbers of a run, by its frames.
void keep_numbers(const std::vector<Snapshot>& frames, const SimulationReport& report);

inline const SimulationOptions as_statics{.statics = true};

}  // namespace nurbeam::verification
