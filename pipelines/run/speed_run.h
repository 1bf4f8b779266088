#pragma once
#include <functional>
#include <optional>

#include "fem/motion/record/simulation_report.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/build_model.h"
#include "pipelines/results/speed_table.h"

namespace nurbeam {

/// Natural frequencies at each of the speeds of `analysis.modes.speeds`, and the critical speeds between
/// them. The rotors turn at the speed, those after the first at their own ratio to it; without rotors the
/// frame does. Lines are told apart by whirl, and counted from the lowest; near speed 0 by their order alone.
/// Empty where a search for rest fails or is interrupted, which `report` says. Warns of a line that jumps
/// over the speed.
std::optional<SpeedTable> modes_over_speed(const CaseFile& c, const BuiltModel& built,
                                           const std::function<bool()>& interrupted, SimulationReport& report,
                                           Findings& findings);

}  // namespace nurbeam
