#pragma once
#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Lets beams whose motion starts in equilibrium run along themselves at first, in the shape that holds them
/// then: rings, and beams between two reels, whose eyelets, reels and velocity give one speed. Errors where
/// they give different ones.
void set_flows(const ResolvedCase& resolved, BeamModel& model, Findings& findings);

}  // namespace nurbeam
