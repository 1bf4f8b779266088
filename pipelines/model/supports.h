#pragma once
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/law_of_motion.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Adds the supports of one beam, and to `motions` what functions of the program prescribe of them; returns
/// their places in reference arc length [m].
std::vector<double> add_supports(const ResolvedCase& resolved, int b, const DrawnBeam& beam,
                                 const ModelFrame& frame, BeamModel& model, std::vector<LawOfMotion>& motions,
                                 Findings& findings);

}  // namespace nurbeam
