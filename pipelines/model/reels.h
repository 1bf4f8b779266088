#pragma once
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Lengthens a beam of the model by what its reels store: straight, along its tangents at its ends. Errors
/// where a reel cannot take such a beam in.
void lengthen_for_reels(const ResolvedCase& resolved, const CaseBeam& from, Beam& beam, Findings& findings);

/// Home nodes of a drawn beam with those of its lengthened ends, as far apart as the next ones. `home` is
/// empty with errors.
std::vector<HomeNode> with_stored_nodes(std::vector<HomeNode> home, const ReferenceCurve& lengthened);

/// Adds the reels to a model that has all else that is at places of beams. `held`: per beam, places that need
/// a node [m].
void add_reels(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
               const std::vector<std::vector<double>>& held, const ModelFrame& frame, BeamModel& model,
               Findings& findings);

/// Warns of reels and eyelets whose motion begins at a speed that the beam does not have: a blow of rho c v
/// [N].
void warn_of_blows(const ResolvedCase& resolved, const BeamModel& model, Findings& findings);

}  // namespace nurbeam
