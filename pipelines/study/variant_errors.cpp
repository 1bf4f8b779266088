#include "pipelines/study/variant_errors.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "pipelines/accuracy/error_bars.h"
#include "pipelines/model/model_snapshot.h"
#include "pipelines/run/accuracy_question.h"
#include "pipelines/run/level_model.h"
#include "pipelines/run/simulation_plan.h"

namespace nurbeam {

VariantErrors::VariantErrors(const StudyFile& study, const CaseFile& case_file, const BuiltModel& built,
                             const std::vector<double>& values)
    : study_(study),
      case_(case_file),
      built_(built),
      values_(values),
      steps_(simulation_options(case_file).output_times),
      has_jumps_(has_jumps_inside(built)) {}

ExpressionScope VariantErrors::scope(const Histories& histories, const std::vector<RunEvent>& events) const {
  return scope_of_run(study_, values_, histories, built_.model, events);
}

void VariantErrors::run(const Histories& own, const std::vector<RunEvent>& events,
                        const std::function<bool()>& interrupted) {
  steps_.end();
  runs_.push_back({0, own, events});
  for (const int level : levels_of_errors(case_, built_, steps_)) {
    const std::optional<BuiltModel> model = at_level(built_, level);
    if (!model) throw std::invalid_argument("a beam has too few or too many elements for its errors");
    AtLevel taken{level, own.of_neighbour(built_), {}};
    SimulationObserver observer;
    observer.interrupted = interrupted;
    observer.contents = own.contents();
    observer.snapshot = [&](const Snapshot& snapshot) { taken.histories.add(snapshot); };
    SimulationReport report =
        simulate(model->model, probe_places(*model), options_at_level(case_, level, steps_), observer);
    if (report.status != SimulationStatus::done)
      throw std::invalid_argument("its errors are not known: a run with other elements ends early, " +
                                  outcome_in_world(report, *model));
    taken.events = std::move(report.events);
    runs_.push_back(std::move(taken));
  }
  std::ranges::sort(runs_, [](const AtLevel& a, const AtLevel& b) { return a.level > b.level; });
  own_ = static_cast<std::size_t>(std::ranges::find(runs_, 0, &AtLevel::level) - runs_.begin());
}

double VariantErrors::error(double number, const std::function<double(const ExpressionScope&)>& of) const {
  std::vector<double> values;
  for (const AtLevel& run : runs_) values.push_back(of(scope(run.histories, run.events)));
  const double off = std::abs(values[0] - number), first = std::abs(values[0] - values[1]);
  if (case_.analysis.type != CaseAnalysis::Type::dynamic)
    return off + bounded_order_error(
                     first, values.size() > 2 ? std::optional(std::abs(values[1] - values[2])) : std::nullopt,
                     has_jumps_);
  const double factor = own_ == 0 ? 1.25 : 1.5;
  const AtLevel &own = runs_[own_], &other = runs_[1 - own_];
  double largest = factor * first;
  for (const double part : {factor, -factor}) {
    const Histories moved = own.histories.moved(other.histories, part);
    largest = std::fmax(largest, std::abs(of(scope(moved, own.events)) - number));
  }
  return largest;
}

bool asks_for_errors(const StudyFile& study) {
  return std::ranges::any_of(
      study.quantities, [](const StudyQuantity& quantity) { return quantity.value.asks_for_errors(); });
}

std::vector<std::string> drowned_in_errors(const StudyFile& study, const std::vector<Variant>& variants) {
  std::vector<std::string> drowned;
  const auto number_of = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(study.quantities, name, &StudyQuantity::name) -
                                    study.quantities.begin());
  };
  for (std::size_t k = 0; k < study.quantities.size(); ++k) {
    const std::size_t e = number_of(study.quantities[k].name + ".error");
    if (e == study.quantities.size()) continue;
    std::vector<double> values, errors;
    for (const Variant& variant : variants)
      if (variant.status == VariantStatus::done) {
        values.push_back(variant.quantities[k]);
        errors.push_back(variant.quantities[e]);
      }
    if (values.size() < 2) continue;
    const auto [least, greatest] = std::ranges::minmax(values);
    if (greatest - least < std::ranges::max(errors)) drowned.push_back(study.quantities[k].name);
  }
  return drowned;
}

}  // namespace nurbeam
