#pragma once
#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Lets the rigid bodies of a model, which has all its parts, start as their joints let them: those without a
/// "velocity" get the one that goes with their spins, riders without a "speed" that of their point. Reports
/// joints that are open at the start, and motions that joints do not let be.
void start_bodies(const ResolvedCase& resolved, BeamModel& model, Findings& findings);

}  // namespace nurbeam
