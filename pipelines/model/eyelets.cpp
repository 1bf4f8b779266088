#include "pipelines/model/eyelets.h"

#include <cmath>
#include <string>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

// Elements stand between an eyelet and whatever else rides on its beam.
void check_apart(const CaseEyelet& eyelet, const Rider& added, const BeamModel& model, Findings& findings) {
  const Beam& beam = model.beam_of(added);
  const double least = meeting_distance * beam.curve.length() / beam.home_intervals();
  for (const Rider& other : model.riders) {
    if (other.beam != added.beam) continue;
    const double apart = std::abs(beam.curve.unrolled(other.s, added.s) - added.s);
    if (apart <= least)
      findings.error(eyelet.path + ".at", "is " + text_of(apart) + " m from " +
                                              in_quotes(model.body_of(other).name) + " on beam " +
                                              in_quotes(eyelet.beam) + "; must be more than " +
                                              text_of(least) + " m away");
  }
}

// A beam that is led elsewhere than drawn gets there in the search for rest.
void check_place(const CaseEyelet& eyelet, double away, const CaseAnalysis& analysis, double length,
                 Findings& findings) {
  const bool as_drawn = analysis.type == CaseAnalysis::Type::dynamic && !analysis.start_from_equilibrium;
  if (as_drawn && away > 1e-9 * length)
    findings.error(eyelet.path + ".position",
                   "is " + text_of(away) + " m from where beam " + in_quotes(eyelet.beam) +
                       " is drawn, but the run starts as drawn; start with \"initial\": \"equilibrium\", or "
                       "leave the \"position\" out");
}

}  // namespace

void add_eyelets(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, const ModelFrame& frame,
                 BeamModel& model, Findings& findings) {
  const CaseAnalysis& analysis = resolved.analysis;
  if (!resolved.eyelets.empty() &&
      (analysis.is_explicit() || std::holds_alternative<Ida>(analysis.integrator)))
    findings.error("analysis.integrator.type", "is not for eyelets; use \"generalized-alpha\" or \"radau\"");
  for (const CaseEyelet& eyelet : resolved.eyelets) {
    const int b = resolved.beam_index(eyelet.beam);
    if (model.beams[b].rigid) {
      findings.error(eyelet.path + ".beam",
                     "is " + in_quotes(eyelet.beam) +
                         ", a rigid guide, which runs through nothing; name an elastic beam");
      continue;
    }
    const Rider rider{.body = static_cast<int>(model.bodies.size()),
                      .beam = b,
                      .s = place_on(beams[b], eyelet.at, eyelet.path, findings),
                      .motion = {},
                      .continuous_slope = eyelet.continuous_slope,
                      .leave_at_end = eyelet.leave_at_end,
                      .rest = eyelet.rest};
    const Eigen::Vector3d drawn = model.beams[b].curve.position(rider.s);
    const Eigen::Vector3d position = eyelet.position ? frame.to_local(*eyelet.position) : drawn;
    check_place(eyelet, (position - drawn).norm(), analysis, model.beams[b].curve.length(), findings);
    check_apart(eyelet, rider, model, findings);
    model.bodies.push_back({.name = eyelet.name, .mass = 0, .position = drawn});
    model.constraints.push_back(HeldBody{rider.body, position});
    model.riders.push_back(rider);
  }
}

}  // namespace nurbeam
