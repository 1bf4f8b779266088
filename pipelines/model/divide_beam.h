#pragma once
#include <vector>

#include "fem/structure/structure.h"
#include "pipelines/case/case_file.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/model_frame.h"

namespace nurbeam {

/// The home nodes of a beam as the case divides it, in the model's material coordinates: at the breaks of the
/// drawing and at the places where the beam is held, in reference arc length [m], and between them. So many
/// bodies slide on the beam. None, with an error among the findings, where it cannot be divided so.
std::vector<HomeNode> divide_beam(const CaseBeam& beam, const DrawnBeam& drawn,
                                  const std::vector<double>& held_places, int sliding_bodies,
                                  const ModelFrame& frame, Findings& findings);

}  // namespace nurbeam
