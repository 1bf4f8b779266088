#pragma once
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Adds the loads of a case; `forces_of_loads` takes, for each load of the case, the numbers of its forces in
/// the model.
void add_loads(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, const ModelFrame& frame,
               BeamModel& model, std::vector<std::vector<int>>& forces_of_loads, Findings& findings);

/// The same of loads on bodies, which the model has.
void add_body_loads(const ResolvedCase& resolved, const ModelFrame& frame, BeamModel& model,
                    std::vector<std::vector<int>>& forces_of_loads, Findings& findings);

}  // namespace nurbeam
