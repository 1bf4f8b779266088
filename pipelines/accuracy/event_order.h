#pragma once
#include <optional>
#include <string>
#include <vector>

#include "pipelines/accuracy/level_numbers.h"

namespace nurbeam {

/// How many events two runs have in common from the start on: of the same kinds, bodies and beams in one
/// order.
std::size_t common_events(const LevelNumbers& one, const LevelNumbers& other);
/// When two runs first have different events [s]; nothing where they never do.
std::optional<double> time_of_other_events(const LevelNumbers& one, const LevelNumbers& other);

/// "mass left the beam"; from the second of a name on with its number, "mass sticks (2)".
std::vector<std::string> names_of_events(const std::vector<RunEvent>& events,
                                         const std::vector<std::string>& bodies);

}  // namespace nurbeam
