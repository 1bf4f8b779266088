#include "pipelines/study/study_run.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <new>
#include <set>

namespace nurbeam {

namespace {

using Clock = std::chrono::steady_clock;

/// Numbers variants in the order in which they are asked for, and runs those that are not there yet.
class VariantSource {
 public:
  VariantSource(const StudyFile& study, StudyEngine& engine, StudyRows& rows, const StudyObserver& observer)
      : study_(study),
        engine_(engine),
        rows_(rows),
        observer_(observer),
        expected_(expected_variants(study)) {
    progress_.at_most = !std::holds_alternative<StudyPlan>(study.task) &&
                        !std::holds_alternative<StudySensitivity>(study.task);
  }

  /// The quantities at these points of the free variables.
  StudyPoints evaluate(const StudyPoints& points) {
    const std::size_t first = variants_.size();
    std::vector<VariantTask> tasks;
    for (const std::vector<double>& point : points) {
      const std::size_t number = variants_.size();
      std::vector<double> values = all_values(study_, point);
      const auto stored = rows_.stored().find(number);
      if (stored != rows_.stored().end() && stored->second.values == values) {
        count(stored->second);
        variants_.push_back(stored->second);
      } else {
        variants_.push_back({.number = number, .values = values});
        tasks.push_back({number, std::move(values)});
      }
    }
    run(tasks);
    StudyPoints quantities;
    for (std::size_t i = first; i < variants_.size(); ++i) quantities.push_back(variants_[i].quantities);
    return quantities;
  }

  /// The derivatives of the variant at a point; none where it is not done.
  StudyGradient derivatives(const std::vector<double>& point) {
    const std::vector<double> values = all_values(study_, point);
    const auto there = [&] {
      return std::find_if(variants_.begin(), variants_.end(),
                          [&](const Variant& variant) { return variant.values == values; });
    };
    if (there() == variants_.end()) evaluate({point});
    return there()->gradient;
  }

  const std::vector<Variant>& variants() const { return variants_; }
  /// Those that have ended, of a study that was interrupted.
  std::vector<Variant> ended() const {
    std::vector<Variant> ended;
    for (const Variant& variant : variants_)
      if (!unfinished_.contains(variant.number)) ended.push_back(variant);
    return ended;
  }

 private:
  void count(const Variant& variant) {
    ++(variant.status == VariantStatus::done ? progress_.done : progress_.failed);
  }

  void run(const std::vector<VariantTask>& tasks) {
    if (tasks.empty()) return;
    for (const VariantTask& task : tasks) unfinished_.insert(task.number);
    progress_.total = std::max(expected_, variants_.size());
    std::size_t ended = 0;
    const auto tell = [&] {
      const double taken = std::chrono::duration<double>(Clock::now() - begun_).count();
      progress_.running =
          std::min<std::size_t>(static_cast<std::size_t>(engine_.workers()), tasks.size() - ended);
      const auto left = static_cast<double>(progress_.total - progress_.done - progress_.failed);
      if (ran_ > 0) progress_.seconds_to_go = taken / static_cast<double>(ran_) * left;
      observer_.progress(progress_);
    };
    tell();
    engine_.run(
        tasks,
        [&](Variant variant) {
          rows_.append(variant);
          count(variant);
          ++ended;
          ++ran_;
          unfinished_.erase(variant.number);
          const std::size_t number = variant.number;
          variants_[number] = std::move(variant);
          tell();
        },
        observer_.interrupted);
    rows_.synchronise();
    if (ended < tasks.size()) throw StudyInterrupted{};
  }

  const StudyFile& study_;
  StudyEngine& engine_;
  StudyRows& rows_;
  const StudyObserver& observer_;
  std::size_t expected_;
  Clock::time_point begun_ = Clock::now();
  std::size_t ran_ = 0;  // since then
  std::vector<Variant> variants_;
  std::set<std::size_t> unfinished_;
  StudyProgress progress_;
};

/// The rows that are done, for functions that are fitted to them.
std::vector<SurrogateResult> surrogates_of(const StudyFile& study, const std::vector<Variant>& variants) {
  StudyPoints inputs, outputs;
  const std::vector<std::size_t> free = study.free_variables();
  for (const Variant& variant : variants) {
    if (variant.status != VariantStatus::done) continue;
    inputs.emplace_back();
    for (const std::size_t i : free) inputs.back().push_back(variant.values[i]);
    outputs.push_back(variant.quantities);
  }
  return make_surrogates(study, *study.surrogate, inputs, outputs);
}

std::vector<Variant> done(const std::vector<Variant>& variants) {
  std::vector<Variant> done;
  for (const Variant& variant : variants)
    if (variant.status == VariantStatus::done) done.push_back(variant);
  return done;
}

// Whether it is a search from the nominal values of the variables.
bool begins_at_nominal(const StudyTask& task) {
  if (const auto* optimum = std::get_if<StudyOptimum>(&task))
    return optimum->method != StudyOptimum::Method::genetic;
  if (const auto* calibration = std::get_if<StudyCalibration>(&task)) return !calibration->prior;
  const auto* reliability = std::get_if<StudyReliability>(&task);
  return reliability && reliability->method != StudyReliability::Method::monte_carlo;
}

// Of a probability about four for each design, and those of its check.
std::size_t variants_of(const StudyOptimum& optimum) {
  constexpr std::size_t of_probability = 4;
  const std::size_t probabilities = optimum.probabilities.size();
  const std::size_t check = optimum.check ? static_cast<std::size_t>(optimum.check->count) : 0;
  return static_cast<std::size_t>(optimum.evaluations) * (1 + of_probability * probabilities) +
         probabilities * check;
}

/// What a method says of its end, with what has become of the variants.
std::string whole_failure(const StudyTask& task, const std::string& of_method,
                          const std::vector<Variant>& variants) {
  const std::string undone = undone_text(variants);
  if (!variants.empty() && done(variants).empty())
    return "none of " + std::to_string(variants.size()) + " variants is done: " + undone +
           (begins_at_nominal(task)
                ? "; the search begins at the \"nominal\" values of the variables, in the "
                  "middle of their ranges when omitted: give such with which a variant runs"
                : "");
  return of_method.empty() || undone.empty() ? of_method
                                             : of_method + "; variants that are not done: " + undone;
}

}  // namespace

std::string undone_text(const std::vector<Variant>& variants) {
  std::map<VariantStatus, std::vector<const Variant*>> undone;
  for (const Variant& variant : variants)
    if (variant.status != VariantStatus::done) undone[variant.status].push_back(&variant);
  std::string text;
  for (const auto& [status, of_it] : undone)
    text += (text.empty() ? "" : ", ") + std::to_string(of_it.size()) + " " + name_of(status) + " (" +
            (of_it.size() > 1 ? "the first: " : "") + of_it.front()->reason + ")";
  return text;
}

std::size_t expected_variants(const StudyFile& study) {
  return std::visit(
      [&](const auto& task) -> std::size_t {
        using Task = std::decay_t<decltype(task)>;
        if constexpr (std::is_same_v<Task, StudyPlan>)
          return plan_points(study, task).size();
        else if constexpr (std::is_same_v<Task, StudySensitivity>)
          return static_cast<std::size_t>(task.count) * (study.free_variables().size() + 2);
        else if constexpr (std::is_same_v<Task, StudyReliability>)
          return static_cast<std::size_t>(task.count);
        else if constexpr (std::is_same_v<Task, StudyOptimum>)
          return variants_of(task);
        else
          return static_cast<std::size_t>(task.evaluations);
      },
      study.task);
}

StudyResult run_study(const StudyFile& study, StudyEngine& engine, StudyRows& rows,
                      const StudyObserver& observer) {
  VariantSource source(study, engine, rows, observer);
  const StudyEvaluation evaluate = [&](const StudyPoints& points) { return source.evaluate(points); };
  StudyDerivatives derivatives;
  if (study.derivatives)
    derivatives = [&](const std::vector<double>& point) { return source.derivatives(point); };
  StudyResult result;
  try {
    std::visit(
        [&](const auto& task) {
          using Task = std::decay_t<decltype(task)>;
          if constexpr (std::is_same_v<Task, StudyPlan>) {
            evaluate(plan_points(study, task));
            if (study.derivatives) result.answer = GradientResult{done(source.variants())};
            if (study.surrogate) result.surrogates = surrogates_of(study, source.variants());
          }
          if constexpr (std::is_same_v<Task, StudySensitivity>)
            result.answer = sobol_indices(study, task, evaluate);
          if constexpr (std::is_same_v<Task, StudyReliability>)
            result.answer = failure_probability(study, task, evaluate, derivatives);
          if constexpr (std::is_same_v<Task, StudyOptimum>)
            result.answer = (task.probabilities.empty() ? find_optimum : find_reliable_optimum)(
                study, task, evaluate, derivatives);
          if constexpr (std::is_same_v<Task, StudyCalibration>)
            result.answer = calibrate(study, task, evaluate, derivatives);
        },
        study.task);
  } catch (const StudyInterrupted&) {
    result.interrupted = true;
  } catch (const StudyRowsError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {  // of the method: its variants stand
    result.failure = problem.what();
  }
  result.variants = source.ended();
  if (!result.interrupted) result.failure = whole_failure(study.task, result.failure, result.variants);
  return result;
}

}  // namespace nurbeam
