#include "pipelines/run/run_checks.h"

#include <optional>
#include <string>

#include "nurbs/number_text.h"
#include "pipelines/run/moment_text.h"
#include "pipelines/run/simulation_plan.h"

namespace nurbeam {

void FrameChecks::look_at(const Snapshot& frame) {
  for (int b = 0; b < static_cast<int>(frame.beams.size()); ++b)
    look_at(frame.beams[b].elements, b, frame.time);
  pulls_.look_at(frame);
  high_stress_.look_at(frame, model_);
  slack_kink_.look_at(frame, model_);
}

void FrameChecks::look_at(std::span<const ElementRecord> elements, int beam, double time) {
  const std::string& name = model_.beams[beam].name;
  mismatch_.look_at(elements, name, time);
  least_strain_.look_at(elements, name, time);
  fold_.look_at(elements, name, time);
  beams_.look_at(elements, beam, time);
}

namespace {

constexpr int digits = 4;

std::string and_moment(const CaseAnalysis& analysis, double time) {
  const std::string moment = moment_text(analysis, time, digits);
  return moment.empty() ? "" : " and " + moment;
}

std::optional<Diagnostic> high_stress_warning(const CaseFile& c, const HighStress& stress) {
  if (stress.value == 0) return {};
  return Diagnostic{
      Severity::warning, c.path.string() + ": beams",
      "the stress of beam \"" + stress.beam + "\" reaches " + text_of(stress.value, digits) +
          " Pa at s = " + text_of(stress.s, digits) + " m" + and_moment(c.analysis, stress.time) +
          (stress.layer ? " (in a layer of " + text_of(*stress.layer, digits) + " m)" : "") +
          ", more than a fiftieth of its Young's modulus, " + text_of(stress.modulus, digits) +
          " Pa, which no metal bears: a load, a section or a unit is wrong, the material is soft, or the "
          "elements there are longer than bending reaches: give more of them"};
}

std::optional<Diagnostic> slack_kink_note(const CaseFile& c, const SlackKink& kink) {
  if (kink.beam.empty()) return {};
  return Diagnostic{Severity::note, c.path.string() + ": beams",
                    "beam \"" + kink.beam + "\" is not under tension at its kink at s = " +
                        text_of(kink.s, digits) + " m" + at_moment(c.analysis, kink.time, digits) +
                        ": no layer of bending is known there, and extremes are without its moment and "
                        "stress"};
}

}  // namespace

std::vector<Diagnostic> run_warnings(const CaseFile& case_file, const BuiltModel& built,
                                     const SimulationReport& run, const FrameChecks& frames) {
  const std::filesystem::path& file = case_file.path;
  std::vector<Diagnostic> warnings = shared_pull_warnings(file, frames.shared_pulls().coarse());
  const auto pressed = compression_warning(case_file, frames.least_strain());
  const auto folds = fold_warning(case_file, frames.fold());
  for (const auto& warning :
       {pressed ? pressed : folds, divergence_warning(file, run), snap_warning(file, run, built.model),
        mechanism_warning(file, run, built), energy_warning(case_file, run), short_steps_note(file, run),
        high_stress_warning(case_file, frames.high_stress()),
        slack_kink_note(case_file, frames.slack_kink())})
    if (warning) warnings.push_back(*warning);
  const auto add = [&](std::vector<Diagnostic> notes) {
    for (Diagnostic& note : notes) warnings.push_back(std::move(note));
  };
  if (!pressed && !folds)
    add(law_notes(case_file, built.model, frames.beams()));  // else strains are the mesh's
  add(given_up_node_notes(file, run, built.model));
  add(undamped_notes(case_file, built.model, frames.beams()));
  add(loose_body_notes(case_file, built.model, run));
  return warnings;
}

}  // namespace nurbeam
