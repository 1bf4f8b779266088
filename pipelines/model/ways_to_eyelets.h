#pragma once
#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Looks for sliding bodies of a motion that come to an eyelet of their beam, which nothing passes: an error
/// where a prescribed motion takes one there, a warning where one that runs freely down the drawn beam,
/// without friction, gets there before the end. Precondition: the model has its riders, stops and elements.
void check_ways_to_eyelets(const ResolvedCase& resolved, const BeamModel& model, Findings& findings);

}  // namespace nurbeam
