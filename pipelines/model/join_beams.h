#pragma once
#include <map>
#include <utility>
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// What the joints between beams are in a model.
struct JoinedBeams {
  std::vector<BeamJoint> joints;
  std::vector<std::size_t> sources;              ///< per joint: which of the case's it is
  std::vector<std::vector<double>> places;       ///< per beam: where others are joined to it [m]
  std::map<std::pair<int, double>, int> groups;  ///< of places, by beam and s, that are held together
};

/// Joins the beams of a case (in its order) where they meet: an error for beams that do not, that are joined
/// there already, or over whose place a body slides. Places are in reference arc length, the joints in the
/// model's material coordinates.
JoinedBeams join_beams(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                       const ModelFrame& frame, Findings& findings);

/// Of places that are joined, one may be supported: the others are held by it.
void check_joined_supports(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                           const JoinedBeams& joined, Findings& findings);

}  // namespace nurbeam
