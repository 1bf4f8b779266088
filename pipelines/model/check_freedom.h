#pragma once
#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Refuses rods, and bodies on several beams, that keep apart what is kept already, so that no forces can be
/// found that do it: in the motion as it starts, and where an equilibrium is sought with sliding bodies held.
/// Warns of speeds at the start that a rod does not let.
void check_freedom(const ResolvedCase& resolved, const BeamModel& model, Findings& findings);

}  // namespace nurbeam
