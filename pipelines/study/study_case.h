#pragma once
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "nurbs/nurbs_curve.h"
#include "pipelines/case/case_file.h"
#include "pipelines/study/study_file.h"

namespace nurbeam {

/// The curve of a beam whose control points variables move.
struct StudyCurve {
  std::size_t beam = 0;  ///< in the case file
  NurbsCurve drawn;      ///< in the coordinates of the case [m], as the axis runs
};

/// The case of a study, ready to be varied: what the case file says with the study's changes, and the curves
/// that variables move.
class StudyCase {
 public:
  /// `json`: the text of the case, overrides applied; `file` heads its messages, and files that it names are
  /// relative to its folder.
  StudyCase(const std::string& json, std::filesystem::path file, std::map<std::string, StudyCurve> curves,
            std::vector<std::filesystem::path> inputs);

  /// The case of the variant in which the variables have these values, one for each: a case file's text, in
  /// which moved curves stand as inline "nurbs". Throws std::invalid_argument, with the name of the variable,
  /// where a value cannot be set or a curve cannot be.
  std::string variant(const std::vector<StudyVariable>& variables, const std::vector<double>& values) const;
  /// That case, read. Throws likewise.
  CaseFileReport read(const std::vector<StudyVariable>& variables, const std::vector<double>& values) const;
  /// That case, of a variant that differs from one that has been read, of `read_values`, by no more than the
  /// shape of curves; else nothing. Throws likewise.
  std::optional<CaseFile> reshaped(const CaseFile& read, const std::vector<double>& read_values,
                                   const std::vector<StudyVariable>& variables,
                                   const std::vector<double>& values) const;

  /// The curves that variables move as they are in that variant, by the name of their beam. Throws likewise.
  std::map<std::string, NurbsCurve> moved(const std::vector<StudyVariable>& variables,
                                          const std::vector<double>& values) const;

  const std::filesystem::path& file() const { return file_; }
  /// The files that its case names: CAD files, tables.
  const std::vector<std::filesystem::path>& inputs() const { return inputs_; }
  /// By the name of the beam.
  const std::map<std::string, StudyCurve>& curves() const { return curves_; }

 private:
  nlohmann::ordered_json json_of(const std::vector<StudyVariable>& variables,
                                 const std::vector<double>& values) const;

  std::shared_ptr<const nlohmann::ordered_json> json_;
  std::filesystem::path file_;
  std::map<std::string, StudyCurve> curves_;
  std::vector<std::filesystem::path> inputs_;
};

struct StudyCaseReport {
  std::optional<StudyCase> value;  ///< empty when any diagnostic is an error
  std::vector<Diagnostic> diagnostics;
  std::vector<StudyChange> changes = {};  ///< those of the study that can be made
};

/// Reads the case of a study, and the curves that its variables move; changes that cannot be made are errors,
/// and left out as more is looked for. Precondition: the study has a case.
StudyCaseReport read_study_case(const StudyFile& study);

}  // namespace nurbeam
