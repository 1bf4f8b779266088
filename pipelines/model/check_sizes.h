#pragma once
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/build_model.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Warns of numbers that cannot be meant, as a wrong unit makes them, each with the value that probably was:
/// a gravity of thousands, a density or modulus in which sound travels faster than in any material, a section
/// as thick as its beam is long or as its bend is wide, a force that stretches its beam to twice its length.
void check_sizes(const ResolvedCase& resolved, const BeamModel& model, const ModelFrame& frame,
                 const std::vector<BeamSource>& sources, Findings& findings);

}  // namespace nurbeam
