#include "cad_import/export_into_step.h"

#include "cad_import/files/ask_program.h"
#include "cad_import/files/atomic_file.h"
#include "cad_import/import_curves.h"

namespace nurbeam {
namespace {

std::string failure(const ChildResult& result) {
  switch (result.status) {
    case ChildResult::Status::timed_out:
      return "reading it takes too long";
    case ChildResult::Status::out_of_memory:
      return "reading it needs too much memory";
    default:
      return result.complaint.empty() ? "the reader crashed on it" : result.complaint;
  }
}

}  // namespace

std::vector<Diagnostic> export_into_step(const std::filesystem::path& source,
                                         const std::filesystem::path& file,
                                         const std::vector<DeformedCurve>& curves) {
  const ImportOptions options;
  const ChildResult result =
      asked(ExchangeRequest{source, curves}, {options.time_limit, options.memory_limit_bytes});
  if (result.status != ChildResult::Status::finished)
    return {{Severity::error, source.string(), failure(result) + "; " + file.string() + " was not written"}};
  const Exchanged exchanged = exchanged_from_bytes(result.output);
  std::vector<Diagnostic> diagnostics = write_at_once(file, exchanged.text);
  for (const std::string& warning : exchanged.warnings)
    diagnostics.push_back({Severity::warning, source.string(), warning});
  return diagnostics;
}

}  // namespace nurbeam
