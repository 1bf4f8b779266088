#include "pipelines/run/run_checkpoint.h"

#include "pipelines/results/file_hash.h"
#include "pipelines/results/restart_file.h"
#include "pipelines/results/run_summary.h"
#include "pipelines/run/model_digest.h"

namespace nurbeam {

std::string digest_of_inputs(const CaseFile& c, const BuiltModel& built) {
  std::string text = std::string(NURBEAM_VERSION) + "\n" + text_without_accuracy(c) + "\n";
  for (const auto& file : built.inputs) text += sha256_of_file(file) + "\n";
  return sha256_of_text(text);
}

std::filesystem::path restart_file(const std::filesystem::path& directory) {
  return directory / "restart.nc";
}

Checkpoint find_checkpoint(const std::filesystem::path& directory, const std::string& inputs) {
  const std::filesystem::path file = restart_file(directory);
  Checkpoint point;
  try {
    point = read_checkpoint(file);
  } catch (const std::runtime_error& problem) {
    throw UnusableCheckpoint(std::string(problem.what()) + "; run without --resume");
  }
  if (point.inputs != inputs)
    throw UnusableCheckpoint(file.string() +
                             ": belongs to another case: the case file, its overrides (--set), a CAD file or "
                             "nurbeam have changed since; run without --resume");
  return point;
}

std::optional<Checkpoint> finished_before(const CaseFile& c, const std::filesystem::path& directory,
                                          const std::string& inputs) {
  if (!c.analysis.accuracy.is_on || !std::filesystem::exists(restart_file(directory))) return {};
  const std::string status = status_of_run(directory);
  if (status != "done" && !status.starts_with(accuracy_status)) return {};
  try {
    return find_checkpoint(directory, inputs);
  } catch (const std::runtime_error&) {
    return {};  // of another case: it is run anew
  }
}

}  // namespace nurbeam
