#pragma once
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Where connectors are fastened to beam b, in reference arc length [m].
std::vector<double> connector_places(const ResolvedCase& resolved, int b, const DrawnBeam& beam,
                                     Findings& findings);

/// Adds the connectors of a case, with the masses of their ends, to a model that has its beams, supports,
/// bodies and sliding joints, and places the bodies without a sliding joint.
void add_connectors(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                    const ModelFrame& frame, BeamModel& model, Findings& findings);

/// Adds the rotational connectors of a case to a model that has its beams.
void add_rotational_connectors(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                               const ModelFrame& frame, BeamModel& model, Findings& findings);

}  // namespace nurbeam
