#include "pipelines/run/accuracy_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "nurbs/number_text.h"
#include "pipelines/accuracy/level_file.h"
#include "pipelines/model/model_snapshot.h"
#include "pipelines/run/accuracy_question.h"
#include "pipelines/run/level_model.h"
#include "pipelines/run/simulation_plan.h"

namespace nurbeam {

namespace {

// Functions of a program act on one thread.
bool has_functions(const BuiltModel& built) { return !built.laws.empty() || !built.motions.empty(); }

bool differ_in_steps(const LevelNumbers& fine, const LevelNumbers& coarse) {
  constexpr double least_ratio = 1.5;
  return static_cast<double>(fine.steps) >= least_ratio * static_cast<double>(coarse.steps);
}

bool may_go_beside(const BuiltModel& built, int threads) {
  return threads != 1 && std::thread::hardware_concurrency() > 1 && !has_functions(built);
}

}  // namespace

AccuracyRun::AccuracyRun(const CaseFile& case_file, const BuiltModel& built, int threads,
                         std::optional<LevelStore> store)
    : case_(case_file),
      built_(built),
      beside_(may_go_beside(built, threads)),
      store_(std::move(store)),
      question_(accuracy_question(case_file, built)),
      recorder_(snapshot_names(built)),
      steps_(is_motion() ? simulation_options(case_file).output_times : std::vector<double>{}) {}

AccuracyRun::~AccuracyRun() {
  stopped_ = true;
  steps_.end();
  if (going_on_.valid()) going_on_.wait();
}

void AccuracyRun::begin() {
  if (!beside_) return;
  going_on_ = std::async(std::launch::async, [this] {
    for (const int level : levels_of_errors(case_, built_, steps_))
      take_one(level, [this] { return stopped_.load(); });
  });
}

void AccuracyRun::take_one(int level, const std::function<bool()>& interrupted) {
  if (has(level) || stopped_) return;
  if (store_)
    if (auto known = read_level(store_->directory, level, store_->inputs)) return keep(std::move(*known));
  const auto start = std::chrono::steady_clock::now();
  const std::optional<BuiltModel> model = at_level(built_, level);
  if (!model) return;
  LevelNumbers numbers = taken_at(level, *model, interrupted);
  numbers.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (stopped_ || interrupted()) return;
  if (store_) write_level(store_->directory, numbers, store_->inputs);
  keep(std::move(numbers));
}

// Elements may be so coarse that a search or a step cannot even begin.
LevelNumbers AccuracyRun::taken_at(int level, const BuiltModel& model,
                                   const std::function<bool()>& interrupted) {
  try {
    return run_level(case_, model, level, steps_, interrupted);
  } catch (const std::exception&) {
    if (has_functions(built_)) throw;
    return {.level = level, .elements = element_count(model.model), .rows = {}};
  }
}

bool AccuracyRun::has(int level) {
  const std::lock_guard lock(mutex_);
  return levels_.contains(level);
}

void AccuracyRun::keep(LevelNumbers numbers) {
  const std::lock_guard lock(mutex_);
  levels_.emplace(numbers.level, std::move(numbers));
}

// Whether all is there that goes on beside; it ends where the run is interrupted.
bool AccuracyRun::wait(const std::function<bool()>& interrupted) {
  constexpr std::chrono::milliseconds interval{20};
  if (!going_on_.valid()) return !stopped_;
  while (going_on_.wait_for(interval) != std::future_status::ready)
    if (interrupted && interrupted()) stopped_ = true;
  going_on_.get();
  if (interrupted && interrupted()) stopped_ = true;
  return !stopped_;
}

// Takes runs, the first of them here, the others meanwhile beside it.
void AccuracyRun::take(const std::vector<int>& levels, const std::function<bool()>& interrupted) {
  const auto here = [&] {
    if (interrupted && interrupted()) stopped_ = true;
    return stopped_.load();
  };
  const std::size_t first = beside_ ? 1 : levels.size();
  if (first < levels.size())
    going_on_ = std::async(std::launch::async, [this, &levels] {
      for (std::size_t i = 1; i < levels.size(); ++i) take_one(levels[i], [this] { return stopped_.load(); });
    });
  for (std::size_t i = 0; i < std::min(first, levels.size()); ++i) take_one(levels[i], here);
  wait(interrupted);
}

bool AccuracyRun::is_done(int level) const {
  const auto found = levels_.find(level);
  return found != levels_.end() && found->second.done;
}

RunsOfErrors AccuracyRun::runs_of(int finest) const {
  const LevelNumbers &fine = levels_.at(finest), &coarse = levels_.at(finest - 1);
  const auto coarser = levels_.find(finest - 2);
  const bool counts = is_done(finest - 2) && (!is_motion() || differ_in_steps(coarse, coarser->second));
  return {&fine, &coarse, counts ? &coarser->second : nullptr};
}

void AccuracyRun::tabulate(int finest) { table_.emplace(question_, runs_of(finest), levels_.at(0)); }

const AccuracyTable* AccuracyRun::finish(const SimulationReport& report,
                                         const std::vector<RunExtreme>& extremes,
                                         const std::optional<ModeTable>& modes,
                                         const std::function<bool()>& interrupted,
                                         const std::function<void(const std::string&)>& tell) {
  steps_.end();
  LevelNumbers own = recorder_.numbers(report);
  own.extremes = extremes;
  own.elements = element_count(built_.model);
  own.step = is_motion() ? case_.analysis.step : std::nullopt;
  if (modes) own.modes = numbers_of_modes(*modes);
  if (!wait(interrupted)) return nullptr;
  if (!beside_) take(levels_of_errors(case_, built_, steps_), interrupted);
  keep(std::move(own));
  // Coarse elements may be too coarse for a motion to end.
  const bool has_coarse = is_done(-1) && (is_motion() ? differ_in_steps(levels_.at(0), levels_.at(-1))
                                                      : is_done(-2) || is_done(1));
  if (!has_coarse && !is_done(1)) take({1}, interrupted);
  if (!is_motion() && !is_done(-1) && !is_done(2)) take({2}, interrupted);
  if (stopped_) return nullptr;
  const int finest = has_coarse && !is_done(1) ? 0 : !is_motion() && is_done(2) ? 2 : 1;
  if (!levels_.contains(finest) || !levels_.contains(finest - 1)) return nullptr;
  tabulate(finest);
  if (question_.target) refine(interrupted, tell);
  return &*table_;
}

double AccuracyRun::work(int level) const {
  const bool both = is_motion() && element_count(built_.model) > 0;
  return std::exp2((both ? 2 : 1) * level);
}

std::vector<int> AccuracyRun::missing_at(int finest) const {
  std::vector<int> missing;
  for (int level = finest; level >= finest - (is_motion() ? 1 : 2); --level)
    if (!levels_.contains(level)) missing.push_back(level);
  return missing;
}

// The finest level, up to the one that the errors ask for, that the limit of work allows.
std::optional<int> AccuracyRun::next_level(int finest, double order) {
  const double excess = table_->worst() / *question_.target;
  const double asked = std::isfinite(excess) && excess > 1 ? std::ceil(std::log2(excess) / order) : 1;
  double done = 0;
  for (const auto& [level, numbers] : levels_) done += work(level);
  for (int level = finest + static_cast<int>(std::clamp(asked, 1.0, 20.0)); level > finest; --level) {
    double more = 0;
    for (const int each : missing_at(level)) more += work(each);
    if (done + more <= case_.analysis.accuracy.limit && at_level(built_, level)) return level;
  }
  return std::nullopt;
}

void AccuracyRun::refine(const std::function<bool()>& interrupted,
                         const std::function<void(const std::string&)>& tell) {
  int finest = table_->accuracy().runs.front().level, stuck = 0;
  double order = 1;
  while (!table_->accuracy().reached) {
    if (stuck == 2) {
      unreached_ = "it comes no nearer as elements and steps are halved";
      return;
    }
    const std::optional<int> next = next_level(finest, order);
    if (!next) {
      unreached_ = "a finer run would take more than " + text_of(case_.analysis.accuracy.limit, 4) +
                   " times the work of the plain run (\"limit\"), or more elements than a beam may have";
      return;
    }
    for (const int level : missing_at(*next)) tell("accuracy: " + text_of_level(level));
    take(missing_at(*next), interrupted);
    if (stopped_) {
      unreached_ = "interrupted";
      return;
    }
    if (!is_done(*next) || !is_done(*next - 1)) {
      unreached_ = "a finer run does not come to its end";
      return;
    }
    const double before = table_->worst();
    tabulate(*next);
    const double most = is_motion() ? 2 : 3;
    if (table_->worst() > 0)
      order = std::clamp(std::log2(before / table_->worst()) / (*next - finest), 1.0, most);
    finest = *next;
    stuck = table_->is_stuck() ? stuck + 1 : 0;
  }
}

std::string AccuracyRun::text_of_level(int level) const {
  const double finer = std::exp2(level);
  std::string text = "a run";
  if (const long elements = element_count(built_.model); elements > 0)
    text += " with " + text_of(static_cast<double>(elements) * finer) + " elements";
  if (case_.analysis.step) text += ", steps of " + text_of(*case_.analysis.step / finer) + " s";
  if (is_motion() && !case_.analysis.step) text += ", steps of 1/" + text_of(finer);
  return text;
}

Accuracy AccuracyRun::accuracy() const {
  Accuracy found = table_->accuracy();
  found.unreached = unreached_;
  return found;
}

}  // namespace nurbeam
