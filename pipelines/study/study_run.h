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
  std::size_t total = 0;                     ///< of the study
  bool at_most = false;                      ///< the total is a bound: a search may end before
  std::optional<double> seconds_to_go = {};  ///< for the rest of the total, at the pace so far
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
  std::string failure;  ///< why there is no answer, or no variant is done; else empty
};

/// "3 failed (why the first one did), 2 rejected (likewise)"; empty where all are done.
std::string undone_text(const std::vector<Variant>& variants);

/// How many variants a study runs, at most where it is a search or a simulation.
std::size_t expected_variants(const StudyFile& study);

/// Runs the variants of a study, and what it asks of them. Variants that are among the rows already do not
/// run again; each that ends is appended to them. The same study has the same variants and the same answer
/// whatever the engine, and however often it went on. Throws StudyRowsError.
StudyResult run_study(const StudyFile& study, StudyEngine& engine, StudyRows& rows,
                      const StudyObserver& observer);

}  // namespace nurbeam
