#include "pipelines/run/run_checks.h"

#include <string>

#include "pipelines/run/simulation_plan.h"

namespace nurbeam {

void FrameChecks::look_at(const Snapshot& frame) {
  for (int b = 0; b < static_cast<int>(frame.beams.size()); ++b)
    look_at(frame.beams[b].elements, b, frame.time);
  pulls_.look_at(frame);
}

void FrameChecks::look_at(std::span<const ElementRecord> elements, int beam, double time) {
  const std::string& name = model_.beams[beam].name;
  mismatch_.look_at(elements, name, time);
  least_strain_.look_at(elements, name, time);
  fold_.look_at(elements, name, time);
}

std::vector<Diagnostic> run_warnings(const CaseFile& case_file, const BuiltModel& built,
                                     const SimulationReport& run, const FrameChecks& frames) {
  const std::filesystem::path& file = case_file.path;
  std::vector<Diagnostic> warnings = shared_pull_warnings(file, frames.shared_pulls().coarse());
  const auto pressed = compression_warning(file, frames.least_strain());
  for (const auto& warning :
       {pressed ? pressed : fold_warning(file, frames.fold()), divergence_warning(file, run),
        snap_warning(file, run, built.model), mechanism_warning(file, run, built.frame),
        energy_warning(case_file, run), short_steps_note(file, run)})
    if (warning) warnings.push_back(*warning);
  return warnings;
}

}  // namespace nurbeam
