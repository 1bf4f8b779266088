#pragma once
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/join_beams.h"
#include "pipelines/model/law_of_motion.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Adds the bodies of a case and the joints by which they slide to a model that has its beams and supports;
/// `motions` takes what functions of the program prescribe; an error for a motion that leaves its beam and
/// for places or speeds of one body that are not one.
void add_sliding_joints(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                        const JoinedBeams& joined, const ModelFrame& frame, BeamModel& model,
                        std::vector<LawOfMotion>& motions, Findings& findings);

}  // namespace nurbeam
