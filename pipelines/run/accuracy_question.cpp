#include "pipelines/run/accuracy_question.h"

#include <algorithm>
#include <cmath>

#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/model_snapshot.h"

namespace nurbeam {

namespace {

bool is_inside(const BeamModel& model, int beam, double s) {
  const Beam& of = model.beams[beam];
  const double near = 1e-9 * of.curve.length();
  return !of.rigid && (of.is_ring() || (s > near && s < of.curve.length() - near));
}

std::vector<std::string> probes_at_jumps(const BuiltModel& built) {
  std::vector<std::string> names;
  for (const Probe& probe : built.probes)
    if (std::ranges::any_of(built.slopes, [&](const SlopeDecision& place) {
          const double near = 1e-9 * built.model.beams[place.beam].curve.length();
          return !place.discontinuous && place.beam == probe.beam && std::abs(place.s - probe.s) <= near &&
                 is_inside(built.model, place.beam, place.s);
        }))
      names.push_back(probe.name);
  return names;
}

std::vector<std::pair<std::string, double>> short_bends(const BuiltModel& built) {
  std::vector<std::pair<std::string, double>> bends;
  for (const SlopeDecision& place : built.slopes)
    if (place.reach && place.element && *place.reach < *place.element)
      bends.emplace_back(built.model.beams[place.beam].name, *place.reach);
  return bends;
}

}  // namespace

bool has_jumps_inside(const BuiltModel& built) {
  const BeamModel& model = built.model;
  const auto is_smooth_place = [&](const SlopeDecision& place) {
    return !place.discontinuous && is_inside(model, place.beam, place.s);
  };
  const auto is_smooth_rider = [&](const Rider& rider) {
    return rider.continuous_slope && !rider.reel && is_inside(model, rider.beam, rider.s);
  };
  return std::ranges::any_of(built.slopes, is_smooth_place) ||
         std::ranges::any_of(model.riders, is_smooth_rider);
}

AccuracyQuestion accuracy_question(const CaseFile& case_file, const BuiltModel& built) {
  const SnapshotNames names = snapshot_names(built);
  AccuracyQuestion question{.model = {.moves = case_file.analysis.type == CaseAnalysis::Type::dynamic,
                                      .quantities = {},
                                      .has_jumps = {}}};
  question.columns = history_columns(names);
  question.model.quantities = history_quantities(question.columns);
  question.model.has_jumps.assign(question.model.quantities.size(), has_jumps_inside(built));
  for (const Beam& beam : built.model.beams) {
    question.model.length = std::max(question.model.length, beam.curve.length());
    if (!beam.rigid)
      question.model.radius_of_gyration =
          std::max(question.model.radius_of_gyration, beam.properties.radius_of_disk() / 2);
  }
  question.bodies = names.bodies;
  question.buckling = case_file.analysis.type == CaseAnalysis::Type::buckling;
  question.target = case_file.analysis.accuracy.target;
  question.of = case_file.analysis.accuracy.of;
  question.short_bends = short_bends(built);
  question.probes_at_jumps = probes_at_jumps(built);
  return question;
}

std::vector<Diagnostic> unknown_in_accuracy(const CaseFile& case_file, const BuiltModel& built) {
  std::vector<Diagnostic> errors;
  if (!case_file.analysis.accuracy.is_on) return errors;
  const bool modes = case_file.analysis.has_modes();
  const AccuracyQuestion question = accuracy_question(case_file, built);
  for (const std::string& name : unknown_numbers(question, modes))
    errors.push_back({Severity::error, case_file.path.string() + ": analysis.accuracy.of",
                      in_quotes(name) + " is no number of this case" +
                          known_names(name, names_of_numbers(question, modes))});
  return errors;
}

}  // namespace nurbeam
