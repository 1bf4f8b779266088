#pragma once
#include <functional>

#include "pipelines/accuracy/level_numbers.h"
#include "pipelines/model/build_model.h"
#include "pipelines/results/mode_table.h"
#include "pipelines/run/level_steps.h"

namespace nurbeam {

/// Frequencies [Hz], or factors of loads.
std::vector<double> numbers_of_modes(const ModeTable& table);

/// The levels of the runs that errors of a case come from besides its own: a coarser one in motion, two in
/// statics; finer ones where elements are too few for that, and in motion where each step ends at a frame.
std::vector<int> levels_of_errors(const CaseFile& case_file, const BuiltModel& built, LevelSteps& steps);

/// How a case is run at a level. `steps` must outlive the run.
SimulationOptions options_at_level(const CaseFile& case_file, int level, LevelSteps& steps);

/// Runs a case on its model at another level (at_level) for its numbers alone. `steps`: those of the case's
/// own run, where it has error control. Exceptions of forces arrive unchanged.
LevelNumbers run_level(const CaseFile& case_file, const BuiltModel& at_level, int level, LevelSteps& steps,
                       const std::function<bool()>& interrupted);

}  // namespace nurbeam
