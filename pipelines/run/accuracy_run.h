#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/accuracy/accuracy_table.h"
#include "pipelines/run/level_run.h"

namespace nurbeam {

/// Where the numbers of levels are kept while a case is refined, and what they belong to.
struct LevelStore {
  std::filesystem::path directory;
  std::string inputs;  ///< digest
};

/// Finds the errors of a run from runs of the same case with other elements and steps, which go on beside it
/// in another thread, or after it where there is none or a program's functions act in the model; and refines
/// the case, where a target is set, until they are small enough.
class AccuracyRun {
 public:
  /// `case_file` and `built` must outlive it. `threads`: the most that may run at a time; 0: one a core.
  AccuracyRun(const CaseFile& case_file, const BuiltModel& built, int threads,
              std::optional<LevelStore> store = {});
  /// Stops what still goes on.
  ~AccuracyRun();
  AccuracyRun(const AccuracyRun&) = delete;
  AccuracyRun& operator=(const AccuracyRun&) = delete;

  /// Starts the first runs beside the case's own.
  void begin();
  /// A frame of the case's own run, in world coordinates; each of its steps.
  void look_at(const Snapshot& frame) { recorder_.look_at(frame); }
  void step(const StepRecord& step) { steps_.add(step); }

  /// The errors of the case's own run, which has come to its end. `tell`: told what is run as it begins;
  /// nothing where it is interrupted before there are any. Throws what forces do, and std::runtime_error
  /// where numbers cannot be kept.
  const AccuracyTable* finish(const SimulationReport& report, const std::vector<RunExtreme>& extremes,
                              const std::optional<ModeTable>& modes, const std::function<bool()>& interrupted,
                              const std::function<void(const std::string&)>& tell);
  /// What finish() has found, with whether the target is reached.
  Accuracy accuracy() const;
  /// Of the frames of the case's own run.
  const std::vector<double>& own_times() const { return levels_.at(0).times; }

 private:
  bool is_motion() const { return case_.analysis.type == CaseAnalysis::Type::dynamic; }
  void take(const std::vector<int>& levels, const std::function<bool()>& interrupted);
  void take_one(int level, const std::function<bool()>& interrupted);
  LevelNumbers taken_at(int level, const BuiltModel& model, const std::function<bool()>& interrupted);
  bool wait(const std::function<bool()>& interrupted);
  bool has(int level);
  void keep(LevelNumbers numbers);
  bool is_done(int level) const;
  RunsOfErrors runs_of(int finest) const;
  void tabulate(int finest);
  void refine(const std::function<bool()>& interrupted, const std::function<void(const std::string&)>& tell);
  std::optional<int> next_level(int finest, double order);
  std::vector<int> missing_at(int finest) const;
  double work(int level) const;
  std::string text_of_level(int level) const;

  const CaseFile& case_;
  const BuiltModel& built_;
  bool beside_;
  std::optional<LevelStore> store_;
  AccuracyQuestion question_;
  LevelRecorder recorder_;
  LevelSteps steps_;
  std::atomic<bool> stopped_ = false;
  std::future<void> going_on_;
  std::mutex mutex_;  // of what follows, while runs go on
  std::map<int, LevelNumbers> levels_;
  std::optional<AccuracyTable> table_;
  std::string unreached_;
};

}  // namespace nurbeam
