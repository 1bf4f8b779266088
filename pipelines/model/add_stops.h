#pragma once
#include <vector>

#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/build_model.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Adds the stops of a case to a model that has its sliding joints.
void add_stops(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, BeamModel& model,
               Findings& findings);

}  // namespace nurbeam
