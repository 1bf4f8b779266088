#include "pipelines/model/flows.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

bool is_ring(const BeamModel& model, const Rider& rider) { return model.body_of(rider).mass == 0; }

// Whether all that a beam meets lets it run: it ends nowhere, nothing is fastened to it, nothing holds it.
bool can_run(const BeamModel& model, int b) {
  const Beam& beam = model.beams[b];
  const auto reels = std::ranges::count_if(
      model.riders, [&](const Rider& rider) { return rider.beam == b && rider.reel && rider.motion; });
  const bool is_held = std::ranges::any_of(
      beam.home, [](const HomeNode& node) { return node.hold != Hold::nothing || node.joined || node.kept; });
  const bool carries = std::ranges::any_of(
      model.riders, [&](const Rider& rider) { return rider.beam == b && !is_ring(model, rider); });
  return !beam.rigid && !beam.has_torsion() && !is_held && !carries && (beam.is_ring() || reels == 2);
}

}  // namespace

void set_flows(const ResolvedCase& resolved, BeamModel& model, Findings& findings) {
  const CaseAnalysis& analysis = resolved.analysis;
  if (analysis.type != CaseAnalysis::Type::dynamic || !analysis.start_from_equilibrium) return;
  for (int b = 0; b < static_cast<int>(model.beams.size()); ++b) {
    if (!can_run(model, b)) continue;
    Beam& beam = model.beams[b];
    struct Said {
      std::string by;
      double speed;
    };
    std::vector<Said> all;
    if (beam.velocity && beam.velocity->along != 0)
      all.push_back({"the \"along\" of its \"initial\" velocity", beam.velocity->along});
    for (const Rider& rider : model.riders)
      if (rider.beam == b && rider.motion)
        all.push_back({in_quotes(model.body_of(rider).name), -rider.motion->at(0).speed});
    if (all.empty()) continue;
    const double v = all.front().speed;
    for (const Said& other : all)
      if (std::abs(other.speed - v) > 1e-9 * std::max(std::abs(v), std::abs(other.speed)))
        findings.error(resolved.beams[b].path,
                       "runs at " + text_of(v) + " m/s by " + all.front().by + ", and at " +
                           text_of(other.speed) + " m/s by " + other.by +
                           " when the motion starts, which stretches what is between; "
                           "give both one speed at first, or a \"ramp\"");
    if (v == 0) continue;
    beam.flow = v;
    if (beam.velocity) beam.velocity->along = 0;
    for (Rider& rider : model.riders)
      if (rider.beam == b && !rider.motion) rider.speed = -v;
  }
}

}  // namespace nurbeam
