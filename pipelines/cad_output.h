#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cad_import/export_curves.h"
#include "pipelines/case_file.h"
#include "pipelines/run_summary.h"
#include "pipelines/simulation.h"

namespace nurbeam {

/// Writes the deformed curves of a run, at the times the case asks for, into its results directory.
class CadOutput {
 public:
  /// curve_names: per beam. Both are kept by reference.
  CadOutput(const CaseFile& case_file, const std::vector<std::string>& curve_names,
            std::filesystem::path directory);

  /// Writes the files of this frame (in world coordinates), if it is one of those asked for, and adds their
  /// names to the summary: "deformed_t0.35.step", "deformed_t0.35_solid.step", or numbered,
  /// "deformed_0035.step", when all frames are wanted; without a time for a static case. A shape that has no
  /// such file is a warning in the summary. Throws std::runtime_error when a file cannot be written.
  void write(const Frame& frame, RunSummary& summary);

 private:
  bool is_wanted(const Frame& frame) const;
  std::string stem(const Frame& frame) const;
  std::vector<NamedCurve> curves(const Frame& frame, CurveParameter parameter) const;
  std::optional<Diagnostic> write_solids(const Frame& frame, const std::filesystem::path& file) const;
  void write(const Frame& frame, const std::string& format, RunSummary& summary) const;

  const CaseFile& case_;
  const std::vector<std::string>& curve_names_;
  std::filesystem::path directory_;
  int frame_ = 0;  // the number of the next one
};

}  // namespace nurbeam
