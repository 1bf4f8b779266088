#include "pipelines/study/variant.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <new>
#include <utility>

#include "fem/motion/run/simulation.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/simulation_text.h"
#include "pipelines/model/build_model.h"
#include "pipelines/model/model_snapshot.h"
#include "pipelines/run/simulation_plan.h"
#include "pipelines/study/gradient.h"
#include "pipelines/study/histories.h"
#include "pipelines/study/variant_errors.h"
#include "solver/algebra/side_by_side.h"

namespace nurbeam {

namespace {

constexpr std::pair<VariantStatus, const char*> status_names[] = {
    {VariantStatus::done, "done"},           {VariantStatus::rejected, "rejected"},
    {VariantStatus::refused, "refused"},     {VariantStatus::failed, "failed"},
    {VariantStatus::timed_out, "timed out"}, {VariantStatus::crashed, "crashed"}};

std::string why_no_number(double value, bool of_run) {
  if (std::isinf(value)) return " is infinite: something is divided by 0, or too large";
  return of_run ? " is no number: what it asks for did not happen, or is not known at that time"
                : " is no number, as 0 / 0 or the root of what is negative";
}

/// "a = 1, b = 2", of the variables that the expression names.
std::string values_in(const Expression& expression, const ExpressionScope& scope) {
  std::string text;
  for (const std::string& name : expression.names())
    text += (text.empty() ? "" : ", ") + name + " = " + text_of(std::get<double>(scope.value(name)));
  return text;
}

void fill_quantities(const StudyFile& study, const ExpressionScope& scope, Variant& variant) {
  for (const StudyQuantity& quantity : study.quantities) {
    try {
      const double value = quantity.value.number(scope);
      if (!std::isfinite(value) && variant.reason.empty())
        variant.reason =
            "the quantity " + in_quotes(quantity.name) + why_no_number(value, !scope.times.empty());
      variant.quantities.push_back(value);
    } catch (const std::invalid_argument& problem) {
      variant.reason = "the quantity " + in_quotes(quantity.name) + ": " + problem.what();
      break;
    }
  }
  if (variant.reason.empty()) return;
  variant.status = VariantStatus::failed;
  variant.quantities.clear();
}

/// Ends a variant that did not run or did not reach its end.
void end(Variant& variant, VariantStatus status, std::string reason) {
  variant.status = status;
  variant.reason = std::move(reason);
}

/// The model of a variant, or why there is none.
struct VariantModel {
  CaseFileReport read;
  BuildReport built = {};
  std::string problem = {};
};

VariantModel model_of(const StudyFile& study, const StudyCase& study_case,
                      const std::vector<double>& values) {
  VariantModel model{.read = study_case.read(study.variables, values)};
  if (!model.read.value) {
    model.problem = first_error(model.read.diagnostics);
  } else {
    model.built = build_model(*model.read.value);
    if (!model.built.value) model.problem = first_error(model.built.diagnostics);
  }
  return model;
}

// The variables without whose values, all others as they are, there would be a model; all where there is none
// such.
std::string to_blame(const StudyFile& study, const StudyCase& study_case, const std::vector<double>& values) {
  std::vector<double> free;
  for (const std::size_t i : study.free_variables()) free.push_back(values[i]);
  std::string some, all;
  for (std::size_t k = 0; k < free.size(); ++k) {
    const StudyVariable& variable = study.variables[study.free_variables()[k]];
    const std::string name = variable.name + " = " + text_of(free[k]);
    all += (all.empty() ? "" : ", ") + name;
    std::vector<double> others = free;
    others[k] = variable.nominal;
    try {
      if (model_of(study, study_case, all_values(study, others)).problem.empty())
        some += (some.empty() ? "" : ", ") + name;
    } catch (const std::invalid_argument&) {  // it is not this one alone
    }
  }
  return some.empty() ? all : some;
}

void simulate_variant(const StudyFile& study, const StudyCase& study_case, Variant& variant) {
  const VariantModel model = model_of(study, study_case, variant.values);
  if (!model.problem.empty())
    return end(variant, VariantStatus::refused,
               "with " + to_blame(study, study_case, variant.values) + ": " + model.problem);
  const CaseFileReport& read = model.read;
  const BuildReport& built = model.built;
  Histories histories(study, *built.value);
  std::optional<VariantErrors> errors;
  if (asks_for_errors(study)) errors.emplace(study, *read.value, *built.value, variant.values);
  const auto start = std::chrono::steady_clock::now();
  bool too_long = false;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& snapshot) { histories.add(snapshot); };
  observer.contents = histories.contents();
  observer.interrupted = [&] {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    too_long = study.time_limit && taken.count() > *study.time_limit;
    return too_long;
  };
  if (errors) observer.progress = [&](const StepRecord& step) { errors->step(step); };
  const SimulationOptions options = simulation_options(*read.value);
  std::optional<VariantGradient> gradient;
  if (study.derivatives) {
    gradient.emplace(study, study_case, variant.values, *read.value, *built.value);
    observer.follower = &gradient->follower();
  }
  const SimulationReport run = simulate(built.value->model, probe_places(*built.value), options, observer);
  if (too_long)
    return end(variant, VariantStatus::timed_out, "took longer than " + text_of(*study.time_limit) + " s");
  if (run.status != SimulationStatus::done)
    return end(variant, VariantStatus::failed, outcome_in_world(run, *built.value));
  ExpressionScope scope = scope_of_run(study, variant.values, histories, built.value->model, run.events);
  if (errors) {
    errors->run(histories, run.events, observer.interrupted);
    scope.error_of = [&](double number, const auto& of) { return errors->error(number, of); };
  }
  fill_quantities(study, scope, variant);
  if (gradient && variant.status == VariantStatus::done)
    variant.gradient = gradient->of_quantities(histories, run.events);
}

// Of a study of formulas.
void fill_formulas(const StudyFile& study, Variant& variant) {
  fill_quantities(study, scope_of_variables(study, variant.values), variant);
  if (!study.derivatives || variant.status != VariantStatus::done) return;
  const std::vector<std::size_t> free = study.free_variables();
  for (const StudyQuantity& quantity : study.quantities) {
    variant.gradient.push_back(differences(study, variant.values, [&](const std::vector<double>& values) {
      return quantity.value.number(scope_of_variables(study, values));
    }));
    for (std::size_t i = 0; i < free.size(); ++i)
      if (!std::isfinite(variant.gradient.back()[i])) {
        variant.quantities.clear();
        variant.gradient.clear();
        return end(variant, VariantStatus::failed,
                   "the quantity " + in_quotes(quantity.name) + " has no derivative by " +
                       in_quotes(study.variables[free[i]].name) + " here");
      }
  }
}

// Of a study whose nominal variant cannot be: the others may.
Diagnostic unchecked(const StudyFile& study, const std::string& why) {
  return {Severity::warning, study.path.string() + ": variables",
          "the nominal variant cannot be built: " + why};
}

// With histories of two times: a quantity must be one number, and the events that it asks for can be.
void check_kind(const StudyFile& study, const StudyQuantity& quantity, const BeamModel& model,
                Findings& findings) {
  const std::vector<std::string> variables = names_of(study.variables);
  std::vector<std::string> known = names_of(model.bodies);
  for (const std::string& beam : names_of(model.beams)) known.push_back(beam);
  const ExpressionScope scope{
      .value = [&](const std::string& name) -> ExpressionValue {
        const bool variable = std::find(variables.begin(), variables.end(), name) != variables.end();
        return variable ? ExpressionValue(1.0) : ExpressionValue(std::vector<double>{1, 2});
      },
      .event_time =
          [&](const std::string& kind, const std::string& of) {
            if (std::find(known.begin(), known.end(), of) == known.end())
              throw std::invalid_argument("the case has no body or beam " + in_quotes(of) +
                                          known_names(of, known));
            return static_cast<double>(first_event({}, model, kind, of));
          },
      .times = {0, 1},
      .error_of = [](double, const auto&) { return 1.0; }};
  try {
    quantity.value.number(scope);
  } catch (const std::invalid_argument& problem) {
    findings.error(quantity.path + ".value", in_quotes(quantity.value.text()) + ": " + problem.what());
  }
}

// Whether a variable changes when a run ends.
bool ends_vary(const StudyFile& study) {
  return std::any_of(
      study.variables.begin(), study.variables.end(),
      [](const StudyVariable& variable) {
        const auto* numbers = variable.target ? std::get_if<CasePaths>(&*variable.target) : nullptr;
        return numbers && std::any_of(
                              numbers->paths.begin(), numbers->paths.end(),
                              [](const std::string& path) { return path.starts_with("analysis."); });
      });
}

// Histories are asked for at times that a run must reach.
void check_times(const StudyFile& study, const CaseFile& case_file, Findings& findings) {
  const SimulationOptions options = simulation_options(case_file);
  if (ends_vary(study)) return;
  const bool is_one = options.output_times.empty();  // equilibrium
  const double begin = is_one ? 0 : options.output_times.front(),
               end = is_one ? 0 : options.output_times.back();
  const std::string extent =
      std::string(options.statics ? "the load steps of the case go" : "a run of this case goes") + " from " +
      text_of(begin) + " s to " + text_of(end) + " s";
  const std::string cure = options.statics ? "\"analysis.load_steps\"" : "a longer \"analysis.end_time\"";
  std::string told;  // of an observation, which is a quantity at each of its times
  for (const StudyQuantity& quantity : study.quantities)
    for (const double time : quantity.value.times()) {
      if (is_between(time, begin, end) || quantity.path == told) continue;
      told = quantity.path;
      findings.error(quantity.path + (quantity.observed ? ".measured" : ".value"),
                     extent + ", and " + text_of(time, all_digits) + " s is not between; give " + cure +
                         " that reaches it, or " +
                         (quantity.observed ? "leave out what was measured there" : "another time"));
    }
}

// What takes sums over the run has none: its tangent does not go along.
void check_derivatives(const StudyFile& study, const StudyCase& study_case, const std::vector<double>& values,
                       const CaseFile& case_file, const BuiltModel& model, Findings& findings) {
  for (const StudyQuantity& quantity : study.quantities)
    for (const std::string& name : quantity.value.names())
      if (name == "energy.total" || name == "energy.dissipated" || name == "energy.input")
        findings.error(quantity.path + ".value",
                       in_quotes(name) +
                           " has no derivative here; take \"derivatives\": \"differences\", or a "
                           "method without derivatives");
  for (const StudyQuantity& quantity : study.quantities)
    if (quantity.value.asks_for_errors())
      findings.error(quantity.path + ".value",
                     in_quotes(quantity.value.text()) +
                         " has no derivative here; take \"derivatives\": \"differences\", or a method "
                         "without derivatives");
  try {
    const VariantGradient gradient(study, study_case, values, case_file, model);
  } catch (const std::invalid_argument& problem) {
    findings.error("variables", problem.what());
  }
}

}  // namespace

std::string first_error(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& d : diagnostics)
    if (d.severity == Severity::error) return d.where + ": " + d.message;
  return "no model can be made";
}

std::string name_of(VariantStatus status) {
  for (const auto& [each, name] : status_names)
    if (each == status) return name;
  return {};
}

std::optional<VariantStatus> variant_status(const std::string& name) {
  for (const auto& [status, each] : status_names)
    if (each == name) return status;
  return {};
}

std::vector<double> all_values(const StudyFile& study, const std::vector<double>& free) {
  std::vector<double> values(study.variables.size(), 0.0);
  const std::vector<std::size_t> at = study.free_variables();
  for (std::size_t i = 0; i < at.size(); ++i) values[at[i]] = free[i];
  for (std::size_t i = 0; i < study.variables.size(); ++i)
    if (const auto& derived = study.variables[i].derived)
      values[i] = derived->number(scope_of_variables(study, values));
  return values;
}

Variant run_variant(const StudyFile& study, const StudyCase* study_case, std::size_t number,
                    std::vector<double> values, int threads) {
  const auto start = std::chrono::steady_clock::now();
  const ThreadLimit limit(threads);
  Variant variant{.number = number, .values = std::move(values)};
  try {
    const ExpressionScope scope = scope_of_variables(study, variant.values);
    for (const Expression& constraint : study.constraints)
      if (constraint.number(scope) == 0)
        end(variant, VariantStatus::rejected,
            in_quotes(constraint.text()) + " does not hold with " + values_in(constraint, scope));
    if (variant.status == VariantStatus::done) {
      if (study_case)
        simulate_variant(study, *study_case, variant);
      else
        fill_formulas(study, variant);
    }
  } catch (const std::invalid_argument& problem) {
    end(variant, VariantStatus::refused, problem.what());
  } catch (const std::bad_alloc&) {  // of the machine, not of the variant
    end(variant, VariantStatus::crashed, "there was not enough memory for it");
  } catch (const std::exception& problem) {
    end(variant, VariantStatus::failed, problem.what());
  }
  const bool may_run_plain =
      variant.status == VariantStatus::refused || variant.status == VariantStatus::failed;
  if (may_run_plain && study.derivatives && study.derivatives_where_known) {
    StudyFile plain = study;
    plain.derivatives = false;
    variant = run_variant(plain, study_case, number, std::move(variant.values), threads);
  }
  variant.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return variant;
}

bool has_derivatives(const StudyFile& study, const StudyCase* study_case) {
  if (!study_case) return true;
  const std::vector<double> nominal = all_values(study, study.nominal());
  Findings findings(study.path.string());
  try {
    const VariantModel model = model_of(study, *study_case, nominal);
    if (!model.problem.empty()) return false;
    check_derivatives(study, *study_case, nominal, *model.read.value, *model.built.value, findings);
  } catch (const std::invalid_argument&) {
    return false;
  }
  return !findings.has_errors();
}

std::vector<Diagnostic> check_quantities(const StudyFile& study, const StudyCase* study_case) {
  if (!study_case) return {};
  const std::vector<double> nominal = all_values(study, study.nominal());
  Findings findings(study.path.string());
  try {
    const CaseFileReport read =
        read_case_text(study_case->variant(study.variables, nominal), study_case->file());
    if (!read.value) return {unchecked(study, first_error(read.diagnostics))};
    const BuildReport built = build_model(*read.value);
    if (!built.value) return {unchecked(study, first_error(built.diagnostics))};
    std::vector<std::string> known = names_of(study.variables);
    for (const HistoryColumn& column : history_columns(snapshot_names(*built.value)))
      known.push_back(column_name(column));
    std::string seen;  // of an observation, which is a quantity at each of its times
    for (const StudyQuantity& quantity : study.quantities) {
      if (quantity.observed && quantity.path == seen) continue;
      seen = quantity.path;
      bool complete = true;
      for (const std::string& name : quantity.value.names()) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        complete = false;
        findings.error(quantity.path + ".value",
                       "a run of this case has no column " + in_quotes(name) + known_names(name, known));
      }
      if (complete) check_kind(study, quantity, built.value->model, findings);
    }
    check_times(study, *read.value, findings);
    if (!findings.has_errors() && study.derivatives && !study.derivatives_where_known)
      check_derivatives(study, *study_case, nominal, *read.value, *built.value, findings);
  } catch (const std::invalid_argument& problem) {
    return {unchecked(study, problem.what())};
  }
  return findings.take();
}

}  // namespace nurbeam
