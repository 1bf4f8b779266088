#include "pipelines/model/cad_files.h"

#include <chrono>

#include "cad_import/import_curves.h"

namespace nurbeam {

const ImportReport& CadFiles::read(const std::filesystem::path& file, Findings& findings) {
  if (const auto found = reports_.find(file); found != reports_.end()) return found->second;
  const auto start = std::chrono::steady_clock::now();
  ImportReport report = import_curves(file, {.interrupted = interrupted_});
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  inputs_.push_back(file);
  findings.append(report.diagnostics);
  return reports_.emplace(file, std::move(report)).first->second;
}

}  // namespace nurbeam
