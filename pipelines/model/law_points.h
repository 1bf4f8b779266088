#pragma once
#include <vector>

#include "fem/forces/custom_force.h"
#include "pipelines/model/build_model.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// The points of a law, each on one body or beam of the model; with errors among the findings there are
/// fewer.
std::vector<Grip> law_points(const CaseLaw& law, const ResolvedCase& resolved,
                             const std::vector<DrawnBeam>& beams, Findings& findings);

}  // namespace nurbeam
