#pragma once
#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Says where bodies and points are drawn that a case fixes to places of beams.
void place_fixed_bodies(ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, const ModelFrame& frame,
                        const BeamModel& model, Findings& findings);

/// Adds the bodies of a case to a model, in their order; those on beams, and points of rigid bodies, are
/// placed later.
void add_bodies(const ResolvedCase& resolved, const ModelFrame& frame, BeamModel& model, Findings& findings);

/// Places the points of rigid bodies, once riders say where bodies on beams are; reports points that their
/// beams are not at.
void place_body_points(const ResolvedCase& resolved, const ModelFrame& frame, BeamModel& model,
                       Findings& findings);

/// Where joints hold a beam at a body, in reference arc length [m].
std::vector<double> body_joint_places(const ResolvedCase& resolved, int b, const DrawnBeam& beam,
                                      Findings& findings);

/// Adds what holds bodies: supports of bodies, and joints of bodies with something.
void add_body_joints(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                     const ModelFrame& frame, BeamModel& model, Findings& findings);

}  // namespace nurbeam
