#pragma once
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/cad_files.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Adds what is measured of the shape of a model that has its supports and eyelets: "BEAM.sag_1" and so on of
/// the spans between places where a beam with more than one span is held, and "NAME.clearance" of each
/// clearance of the case.
void add_measures(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, const ModelFrame& frame,
                  CadFiles& files, BeamModel& model, Findings& findings);

}  // namespace nurbeam
