#include "pipelines/model/eyelets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "fem/motion/events/friction_modes.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/place_motions.h"
#include "pipelines/model/rings.h"

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
  if (!as_drawn || away <= 1e-9 * length) return;
  const std::string where = " m from where beam " + in_quotes(eyelet.beam) +
                            " is drawn, but the run starts as drawn; ",
                    cure = "start with \"initial\": \"equilibrium\"";
  if (!eyelet.on.empty())
    findings.error(eyelet.path + ".on", "is body " + in_quotes(eyelet.on) + ", which is " + text_of(away) +
                                            where + cure + ", or put the body there");
  else if (!eyelet.moves.empty())
    findings.error(eyelet.path + ".path", "begins " + text_of(away) + where + cure + ", or begin there");
  else
    findings.error(eyelet.path + ".position",
                   "is " + text_of(away) + where + cure + ", or leave the \"position\" out");
}

// Puts an eyelet near a corner of the drawing exactly there.
void stand_at_corner(const DrawnBeam& beam, Rider& rider) {
  constexpr double near = 1e-6;  // part of the length
  for (const Corner& corner : beam.led_corners) {
    const double s = beam.curve.breaks()[corner.after_segment + 1];
    if (std::abs(rider.s - s) <= near * beam.curve.length()) rider.s = s;
  }
}

// Where the drawing has the wrap, no run is needed to see that it is too large.
void check_wrap(const CaseEyelet& eyelet, const DrawnBeam& beam, const Rider& rider, Findings& findings) {
  if (!rider.friction || rider.friction->law != Friction::Law::coulomb ||
      rider.friction->sticking_coefficient() == 0)
    return;
  for (const Corner& corner : beam.led_corners)
    if (rider.s == beam.curve.breaks()[corner.after_segment + 1] && corner.angle > most_wrap_of_coulomb)
      findings.error(eyelet.path + ".friction.law",
                     "is \"coulomb\", but beam " + in_quotes(eyelet.beam) + " is drawn with a corner of " +
                         text_of(corner.angle * 180 / std::numbers::pi, 4) +
                         " degrees there, and the bound of Coulomb's law grows without limit towards 180; "
                         "above 120 degrees use \"capstan\", or \"bearing\" for a pulley that turns");
}

// Every corner of a beam that eyelets lead has one.
void check_corners(const CaseBeam& from, int b, const DrawnBeam& beam, const BeamModel& model,
                   Findings& findings) {
  for (const Corner& corner : beam.led_corners) {
    const double s = beam.curve.breaks()[corner.after_segment + 1];
    const bool is_led = std::ranges::any_of(model.riders, [&](const Rider& rider) {
      return rider.beam == b && rider.s == s && model.body_of(rider).mass == 0;
    });
    if (!is_led)
      findings.error(from.path + ".axis", "the axis has a corner of " +
                                              text_of(corner.angle * 180 / std::numbers::pi) +
                                              " degrees at " + text_of(corner.point) +
                                              ", and no eyelet leads the beam round it: put one there, or "
                                              "round the corner");
  }
}

}  // namespace

void add_eyelets(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, const ModelFrame& frame,
                 BeamModel& model, Findings& findings) {
  const CaseAnalysis& analysis = resolved.analysis;
  Rings rings(resolved, frame, model);
  if (!resolved.eyelets.empty() && analysis.is_explicit())
    findings.error("analysis.integrator.type",
                   "is \"rk4\", which is not for eyelets; use \"generalized-alpha\" or \"radau\"");
  for (const CaseEyelet& eyelet : resolved.eyelets) {
    const int b = resolved.beam_index(eyelet.beam);
    if (model.beams[b].rigid) {
      findings.error(eyelet.path + ".beam",
                     "is " + in_quotes(eyelet.beam) +
                         ", a rigid guide, which runs through nothing; name an elastic beam");
      continue;
    }
    Rider rider{.body = static_cast<int>(model.bodies.size()),
                .beam = b,
                .s = place_on(beams[b], eyelet.at, eyelet.path, findings),
                .motion = {},
                .release = analysis.type == CaseAnalysis::Type::dynamic ? eyelet.release : std::nullopt,
                .continuous_slope = eyelet.continuous_slope || eyelet.direction.has_value(),
                .leave_at_end = eyelet.leave_at_end,
                .rest = eyelet.rest,
                .friction = ring_friction(eyelet.friction, analysis, model.beams[b]),
                .turning_inertia = eyelet.inertia,
                .drive_force = eyelet.force};
    stand_at_corner(beams[b], rider);
    check_wrap(eyelet, beams[b], rider, findings);
    const Eigen::Vector3d drawn = model.beams[b].curve.position(rider.s);
    rider.motion = place_motion_of(eyelet.motion,
                                   {.path = eyelet.path,
                                    .beam = eyelet.beam,
                                    .curve = &beams[b].curve,
                                    .s = rider.s,
                                    .from_start = true},
                                   analysis, findings);
    const Rings::Place ring = rings.place_of({eyelet.on, eyelet.position, eyelet.moves}, drawn);
    check_place(eyelet, (ring.position - drawn).norm(), analysis, model.beams[b].curve.length(), findings);
    check_apart(eyelet, rider, model, findings);
    rider.direction =
        sleeve_direction(eyelet.direction, eyelet.path, model.beams[b].curve, rider.s, frame, findings);
    rings.add(eyelet.name, drawn, ring);
    model.riders.push_back(rider);
  }
  for (std::size_t b = 0; b < beams.size(); ++b)
    check_corners(resolved.beams[b], static_cast<int>(b), beams[b], model, findings);
}

}  // namespace nurbeam
