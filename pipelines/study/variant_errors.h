#pragma once
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "pipelines/run/level_run.h"
#include "pipelines/study/histories.h"
#include "pipelines/study/variant.h"

namespace nurbeam {

/// The errors of mesh and step of the quantities of a variant, from runs with other elements and steps.
class VariantErrors {
 public:
  /// What outlives it: all of these.
  VariantErrors(const StudyFile& study, const CaseFile& case_file, const BuiltModel& built,
                const std::vector<double>& values);

  /// A step of the variant's own run.
  void step(const StepRecord& step) { steps_.add(step); }
  /// Takes the other runs, after the variant's own one. Throws std::invalid_argument where they do not come
  /// to their ends.
  void run(const Histories& own, const std::vector<RunEvent>& events,
           const std::function<bool()>& interrupted);
  /// The error of a number that `of` gives of each run.
  double error(double number, const std::function<double(const ExpressionScope&)>& of) const;

 private:
  /// One of the runs.
  struct AtLevel {
    int level;
    Histories histories;
    std::vector<RunEvent> events;
  };
  ExpressionScope scope(const Histories& histories, const std::vector<RunEvent>& events) const;

  const StudyFile& study_;
  const CaseFile& case_;
  const BuiltModel& built_;
  const std::vector<double>& values_;
  LevelSteps steps_;
  bool has_jumps_;
  std::deque<AtLevel> runs_;  // the finest first, the own one among them
  std::size_t own_ = 0;
};

/// Whether quantities ask for their errors.
bool asks_for_errors(const StudyFile& study);

/// Of which quantities all variants differ by less than their errors, NAME.error: what a study finds of them
/// is their noise.
std::vector<std::string> drowned_in_errors(const StudyFile& study, const std::vector<Variant>& variants);

}  // namespace nurbeam
