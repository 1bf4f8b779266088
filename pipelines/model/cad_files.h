#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "cad_import/report/import_report.h"
#include "pipelines/diagnostics/findings.h"

namespace nurbeam {

/// The CAD files that a case names, each read once.
class CadFiles {
 public:
  /// `interrupted`: of ImportOptions.
  explicit CadFiles(std::function<bool()> interrupted = {}) : interrupted_(std::move(interrupted)) {}

  /// The curves of a file; what is to be said of it is added to the findings when it is read.
  const ImportReport& read(const std::filesystem::path& file, Findings& findings);

  /// In the order in which they were read.
  const std::vector<std::filesystem::path>& inputs() const { return inputs_; }
  /// What reading them took [s].
  double seconds() const { return seconds_; }

 private:
  std::function<bool()> interrupted_;
  std::map<std::filesystem::path, ImportReport> reports_;
  std::vector<std::filesystem::path> inputs_;
  double seconds_ = 0;
};

}  // namespace nurbeam
