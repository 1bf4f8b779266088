#pragma once
#include <functional>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "pipelines/study/analysis.h"
#include "pipelines/study/engine.h"
#include "pipelines/study/rows.h"

namespace nurbeam {

/// How far a study is.
struct StudyProgress {
  std::size_t done = 0, failed = 0;  ///< variants that have ended
  std::size_t running = 0;
  std::size_t total = 0;     ///< of this batch and those before it
  double seconds_to_go = 0;  ///< for the rest of the batch, at the present pace
};

struct StudyObserver {
  std::function<bool()> interrupted = [] { return false; };
  std::function<void(const StudyProgress&)> progress = [](const StudyProgress&) {};
};

/// The variants of a plan that are done, with their derivatives.
struct GradientResult {
  std::vector<Variant> variants;
};

using StudyAnswer = std::variant<std::monostate, GradientResult, SensitivityResult, ReliabilityResult,
                                 OptimumResult, CalibrationResult>;

/// What came out of a study.
struct StudyResult {
  std::vector<Variant> variants;  ///< by number
  StudyAnswer answer;             ///< of what is no plan
  std::vector<SurrogateResult> surrogates;
  bool interrupted = false;
  std::string failure;  ///< why there is no answer; empty where there is one, or none was asked for
};

/// Runs the variants of a study, and what it asks of them. Variants that are among the rows already do not
/// run again; each that ends is appended to them. The same study has the same variants and the same answer
/// whatever the engine, and however often it went on. Throws StudyRowsError.
StudyResult run_study(const StudyFile& study, StudyEngine& engine, StudyRows& rows,
                      const StudyObserver& observer);

}  // namespace nurbeam
