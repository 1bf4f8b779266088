#include "pipelines/model/supports.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "nurbs/number_text.h"
#include "pipelines/model/prescribed_angle.h"

namespace nurbeam {

namespace {

// Speeds that jump are blows on the beam.
void note_jumps(const std::string& path, const DisplacementTable& motion, double end_time,
                Findings& findings) {
  double largest = 0, at = 0;
  for (const auto& [time, place] : motion.components()[0].rows()) {
    if (time >= end_time) break;
    Eigen::Vector3d jump;
    for (int k = 0; k < 3; ++k) {
      const auto [before, after] = *motion.components()[k].slopes_at(time);
      jump[k] = after - before;
    }
    if (jump.norm() <= largest) continue;
    largest = jump.norm();
    at = time;
  }
  if (largest > 0)
    findings.add(
        Severity::note, path + ".interpolation",
        "\"linear\" makes the speed jump at the rows, by up to " + text_of(largest, 4) + " m/s at " +
            text_of(at, 6) +
            " s: each jump is a blow that runs along the beam as a wave, which steps shorter than its "
            "way along an element resolve");
}

// A motion begins where the beam is drawn, unless the run begins with a search for rest.
std::optional<DisplacementTable> motion_of(const ResolvedCase& resolved, const CaseSupport& support,
                                           const ModelFrame& frame, Findings& findings) {
  if (support.motion.empty()) return {};
  std::vector<DisplacementTable::Row> rows;
  for (const auto& [time, displacement] : support.motion)
    rows.emplace_back(time, frame.direction_to_local(displacement));
  const CaseAnalysis& analysis = resolved.analysis;
  const bool moves = analysis.type == CaseAnalysis::Type::dynamic;  // else it grows with the load factor
  const DisplacementTable motion(rows, moves ? support.motion_join : RowJoin::linear);
  if (moves && support.motion_join == RowJoin::linear)
    note_jumps(support.path, motion, analysis.end_time, findings);
  const double start = motion.at(0).value.norm();
  if (start > 0 && analysis.type == CaseAnalysis::Type::dynamic && !analysis.start_from_equilibrium)
    findings.error(
        support.path + ".motion",
        "is " + text_of(start) +
            " m from the drawn place at time 0, but the run starts as drawn; begin with [0, 0, 0, 0], "
            "or start with \"initial\": \"equilibrium\"");
  return motion;
}

// A turn begins at the drawing, unless the run begins with a search for rest.
std::optional<AxisTurn> turn_in(const ResolvedCase& resolved, const CaseSupport& support,
                                const Eigen::Vector3d& place, const Beam& beam, const ModelFrame& frame,
                                Findings& findings) {
  if (!support.rotation) return {};
  const CaseRotation& from = *support.rotation;
  const CaseAnalysis& analysis = resolved.analysis;
  const bool moves = analysis.type == CaseAnalysis::Type::dynamic;
  const Eigen::Vector3d axis = frame.moment_to_local(from.axis.stableNormalized()).normalized();
  const AngleMotion angle = prescribed_angle(from, analysis, findings);
  if (const double start = angle.at(0).angle; start != 0 && starts_as_drawn(analysis))
    findings.error(from.path + ".table",
                   "is at " + text_of(start * 180 / std::numbers::pi) +
                       " degrees at time 0, but the run starts as drawn; begin with [0, 0], or start with "
                       "\"initial\": \"equilibrium\"");
  if (from.speed && !(from.ramp > 0) && *from.speed != 0 && moves && !beam.velocity)
    findings.warn(from.path + ".speed",
                  "is there at once, which is a blow on beam \"" + support.beam +
                      "\" at rest; give a \"ramp\", or let the beam turn from the start by its "
                      "\"initial\": { \"velocity\": { \"rotation\" } }");
  return AxisTurn{axis, from.about ? frame.to_local(*from.about) : place, angle};
}

// Makes a support guided, with what pulls it.
void add_guide(const CaseSupport& from, const ModelFrame& frame, Support& support, BeamModel& model) {
  support.guide = frame.direction_to_local(from.direction->stableNormalized());
  if (from.force != 0)
    model.forces.push_back(PointLoad{
        {.beam = support.beam, .s = support.s, .value = from.force * *support.guide, .permanent = true}});
  if (from.mass > 0)
    model.forces.push_back(
        PlaceMass{.beam = support.beam, .s = support.s, .mass = from.mass, .weighs = false});
}

}  // namespace

std::vector<double> add_supports(const ResolvedCase& resolved, int b, const DrawnBeam& beam,
                                 const ModelFrame& frame, BeamModel& model, std::vector<LawOfMotion>& motions,
                                 Findings& findings) {
  const double same = same_place * beam.measured.length();
  std::vector<double> places;
  std::vector<std::string> paths;
  for (const CaseSupport& support : resolved.supports) {
    if (resolved.beam_index(support.beam) != b) continue;
    const double s = place_on(beam, support.at, support.path, findings);
    for (std::size_t i = 0; i < places.size(); ++i)
      if (std::abs(places[i] - s) < same)
        findings.error(support.path,
                       "holds beam \"" + support.beam + "\" at s = " + text_of(s) + " m, where " + paths[i] +
                           " already holds it; keep one of them (\"clamped\" holds what \"pinned\" holds)");
    places.push_back(s);
    paths.push_back(support.path);
    if (support.motion_law)
      motions.push_back({.path = support.path,
                         .function = *support.motion_law,
                         .constraint = static_cast<int>(model.constraints.size())});
    model.constraints.push_back(Support{.beam = b,
                                        .s = beam.material_coordinate(s),
                                        .clamped = support.type == CaseSupport::Type::clamped,
                                        .fork = support.type == CaseSupport::Type::fork,
                                        .name = support.name,
                                        .motion = motion_of(resolved, support, frame, findings)});
    Support& added = std::get<Support>(model.constraints.back());
    if (support.axis) added.axis = frame.direction_to_local(*support.axis);
    if (support.direction) add_guide(support, frame, added, model);
    added.turn =
        turn_in(resolved, support, model.beams[b].curve.position(added.s), model.beams[b], frame, findings);
  }
  return places;
}

}  // namespace nurbeam
