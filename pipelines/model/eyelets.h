#pragma once
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Adds the eyelets of a case to a model that has its beams, bodies and sliding joints: of each a ring
/// without mass, what holds it, and the rider by which the beam runs through it.
void add_eyelets(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, const ModelFrame& frame,
                 BeamModel& model, Findings& findings);

}  // namespace nurbeam
