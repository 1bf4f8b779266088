#pragma once
#include <functional>

#include "fem/motion/simulation_report.h"
#include "pipelines/results/mode_table.h"
#include "pipelines/run/run_outputs.h"

namespace nurbeam {

/// Computes the modes or the buckling factors that a case asks for. The first frame is the state they are
/// about, at time 0; frame i shows mode i, at time i, with an amplitude that makes it visible, and as
/// velocities (0 for buckling) those with which it swings through the state. Throws std::runtime_error where
/// `outputs` does.
SimulationReport run_modes(const CaseFile& c, const BuiltModel& built,
                           const std::function<bool()>& interrupted, RunOutputs& outputs, ModeTable& table);

}  // namespace nurbeam
