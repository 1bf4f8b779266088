#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/case_file.h"
#include "pipelines/simulation.h"

namespace nurbeam {

/// Writes the deformed curves of a run, at the times the case asks for, into its results directory.
class CadOutput {
 public:
  /// curve_names: per beam. All three are kept by reference.
  CadOutput(const CaseOutput& output, const CaseAnalysis& analysis,
            const std::vector<std::string>& curve_names, std::filesystem::path directory);

  /// Writes the files of this frame (in world coordinates), if it is one of those asked for, and adds their
  /// names to `files`. Throws std::runtime_error when a file cannot be written.
  void write(const Frame& frame, std::vector<std::filesystem::path>& files) const;

 private:
  bool is_wanted(const Frame& frame) const;

  const CaseOutput& output_;
  const CaseAnalysis& analysis_;
  const std::vector<std::string>& curve_names_;
  std::filesystem::path directory_;
};

}  // namespace nurbeam
