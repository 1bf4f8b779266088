#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cad_import/export_curves.h"
#include "fem/motion/record/snapshot.h"
#include "pipelines/case/case_file.h"
#include "pipelines/model/build_model.h"
#include "pipelines/results/export_results.h"

namespace nurbeam {

/// Writes the deformed curves of a run, at the times the case asks for, into its results directory.
class CadOutput {
 public:
  /// The first two are kept by reference. `first_frame`: the number of the first frame that will be written.
  CadOutput(const CaseFile& case_file, const BuiltModel& built, std::filesystem::path directory,
            std::size_t first_frame = 0);

  /// Writes the files of this frame (in world coordinates), if it is one of those asked for, those of curves
  /// with the next flush():
  /// "deformed_t0.35.step", "deformed_t0.35_solid.step", "deformed_t0.35_section_lines.step",
  /// "deformed_t0.35_source.step", or numbered,
  /// "deformed_0035.step", when all frames are wanted; without a time for a static case. What keeps a shape
  /// out of a file is a warning among the diagnostics, once.
  void write(const Snapshot& frame, std::vector<Diagnostic>& diagnostics);
  /// Writes the files of curves of the frames so far, all at once. Throws std::runtime_error when one cannot
  /// be written.
  void flush();

 private:
  bool is_wanted(const Snapshot& frame) const;
  // Six digits, or as many as tell it from the other times that the case lists.
  std::string time_text(double time) const;
  std::string stem(const Snapshot& frame) const;
  std::vector<NamedCurve> curves(const Snapshot& frame, CurveParameter parameter, WholeConics conics) const;
  std::vector<Diagnostic> write_solids(const Snapshot& frame, const std::filesystem::path& file) const;
  std::vector<Diagnostic> write_section_lines(const Snapshot& frame, const std::filesystem::path& file) const;
  std::vector<Diagnostic> write_into_source(const Snapshot& frame, const std::filesystem::path& file) const;
  void write(const Snapshot& frame, const std::string& format, std::vector<Diagnostic>& diagnostics);

  const CaseFile& case_;
  const BuiltModel& built_;
  std::filesystem::path directory_;
  std::size_t frame_;                // the number of the next one
  std::vector<CurvesFile> pending_;  // what flush() writes
};

}  // namespace nurbeam
