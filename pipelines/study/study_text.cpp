#include <algorithm>
#include <cmath>
#include <sstream>

#include "nurbs/number_text.h"
#include "pipelines/study/study_output.h"

namespace nurbeam {

namespace {

/// A value with its unit, where it has one.
std::string with_unit(double value, const std::string& unit, int digits) {
  return text_of(value, digits) + (unit.empty() ? "" : " " + unit);
}

/// "mm by m": of a derivative.
std::string unit_of_derivative(const StudyQuantity& quantity, const StudyVariable& variable) {
  const auto part = [](const std::string& unit) { return unit.empty() ? std::string("1") : unit; };
  if (quantity.unit.empty() && variable.unit.empty()) return "";
  return variable.unit.empty() ? quantity.unit : part(quantity.unit) + " per " + variable.unit;
}

void tell(std::ostream&, const StudyFile&, std::monostate) {}

void tell(std::ostream& out, const StudyFile& study, const GradientResult& result) {
  const std::vector<std::size_t> free = study.free_variables();
  for (const Variant& variant : result.variants)
    for (std::size_t k = 0; k < variant.gradient.size(); ++k) {
      const StudyQuantity& quantity = study.quantities[k];
      out << quantity.name << " = " << with_unit(variant.quantities[k], quantity.unit, 8) << "\n";
      for (std::size_t i = 0; i < free.size(); ++i) {
        const StudyVariable& by = study.variables[free[i]];
        out << "  by " << by.name << "  "
            << with_unit(variant.gradient[k][i], unit_of_derivative(quantity, by), 8) << "\n";
      }
    }
}

void tell(std::ostream& out, const StudyFile& study, const SensitivityResult& result) {
  const std::vector<std::size_t> free = study.free_variables();
  for (const SobolIndices& indices : result.indices) {
    out << "Sobol indices of " << indices.quantity << "\n";
    for (std::size_t i = 0; i < free.size(); ++i) {
      const auto& first = indices.first_order[i];
      const auto& total = indices.total_order[i];
      out << "  " << study.variables[free[i]].name << "  first order " << text_of(first.value, 3) << " ("
          << text_of(first.lower, 3) << " to " << text_of(first.upper, 3) << ")  total "
          << text_of(total.value, 3) << " (" << text_of(total.lower, 3) << " to " << text_of(total.upper, 3)
          << ")\n";
    }
  }
  if (result.rows_left_out > 0)
    out << result.rows_left_out << " rows of the sample were left out: a variant of theirs is not done\n";
}

void tell(std::ostream& out, const StudyFile& study, const ReliabilityResult& result) {
  out << "probability " << text_of(result.probability, 6);
  if (result.coefficient_of_variation)
    out << " (coefficient of variation " << text_of(*result.coefficient_of_variation, 3) << ")";
  if (result.reliability_index) out << "  reliability index " << text_of(*result.reliability_index, 8);
  out << "\n";
  if (result.not_done > 0)
    out << "  " << result.not_done
        << " variants are not done (see study.csv): they count as ones that do not fail\n";
  const std::vector<std::size_t> free = study.free_variables();
  for (std::size_t i = 0; i < result.design_point.size(); ++i)
    out << "  " << study.variables[free[i]].name << " = "
        << with_unit(result.design_point[i], study.variables[free[i]].unit, 6) << " at the design point"
        << (result.importance.empty() ? "" : ", importance " + text_of(result.importance[i], 3)) << "\n";
}

// After how many variants a search had come as near to the value it found in the end.
std::size_t variants_until(const std::vector<double>& history, double part) {
  const double best = history.back();
  const auto near = std::find_if(history.begin(), history.end(), [&](double value) {
    return std::abs(value - best) <= part * std::abs(best);
  });
  return static_cast<std::size_t>(near - history.begin()) + 1;
}

// Of the design variables, which the derivatives of an index are by.
std::vector<std::string> design_names(const StudyFile& study) {
  std::vector<std::string> names;
  for (const std::size_t i : study.free_variables())
    if (!study.variables[i].is_random) names.push_back(study.variables[i].name);
  return names;
}

void tell(std::ostream& out, const StudyFile& study, const ProbabilityResult& result) {
  out << "  " << result.text << "\n";
  if (!result.form.reliability_index) return;
  out << "    FORM: probability " << text_of(result.form.probability, 4) << "  reliability index "
      << text_of(*result.form.reliability_index, 6) << " of " << text_of(result.least_index, 6)
      << " that are asked for\n";
  if (result.check) {
    out << "    simulation: probability " << text_of(result.check->probability, 4);
    if (result.check->coefficient_of_variation)
      out << " (coefficient of variation " << text_of(*result.check->coefficient_of_variation, 3) << ")";
    if (result.check->not_done > 0)
      out << "; " << result.check->not_done << " variants are not done and count as ones that do not fail";
    out << "\n";
  }
  const std::vector<double> values = all_values(study, result.form.design_point);
  std::size_t random = 0;
  for (std::size_t i = 0; i < study.variables.size(); ++i)
    if (const StudyVariable& variable = study.variables[i]; variable.is_random) {
      out << "    " << variable.name << " = " << with_unit(values[i], variable.unit, 6)
          << " at the design point";
      if (!result.form.importance.empty())
        out << ", importance " << text_of(result.form.importance[random++], 3);
      out << "\n";
    }
  const std::vector<std::string> designs = design_names(study);
  for (std::size_t i = 0; i < result.index_gradient.size(); ++i)
    out << "    reliability index by " << designs[i] << "  " << text_of(result.index_gradient[i], 6) << "\n";
}

void tell(std::ostream& out, const StudyFile& study, const OptimumResult& result) {
  constexpr std::size_t most_lines = 20;
  out << (result.points.size() > 1 ? std::to_string(result.points.size()) + " points of the Pareto front\n"
                                   : std::string("best variant\n"));
  for (std::size_t i = 0; i < std::min(most_lines, result.points.size()); ++i) {
    const std::vector<double> values = all_values(study, result.points[i]);
    for (std::size_t k = 0; k < values.size(); ++k)
      out << "  " << study.variables[k].name << " = " << with_unit(values[k], study.variables[k].unit, 8);
    for (std::size_t k = 0; k < study.quantities.size(); ++k)
      out << "  " << study.quantities[k].name << " = "
          << with_unit(result.quantities[i][k], study.quantities[k].unit, 8);
    out << "\n";
  }
  if (result.points.size() > most_lines)
    out << "  the first " << most_lines << " of them, by the first objective; study.json has all\n";
  for (const ProbabilityResult& probability : result.probabilities) tell(out, study, probability);
  if (result.points.size() == 1 && !result.history.empty())
    out << "  within 1 % of it after " << variants_until(result.history, 0.01)
        << " variants, within 0.1 % after " << variants_until(result.history, 0.001) << ", of "
        << result.history.size() << "\n";
  if (result.cut_off)
    out << "  the search has used up its \"evaluations\": give more of them to see whether it gets better\n";
}

void tell(std::ostream& out, const StudyFile& study, const CalibrationResult& result) {
  const auto& calibration = std::get<StudyCalibration>(study.task);
  const std::vector<std::size_t> free = study.free_variables();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const std::string& unit = study.variables[free[i]].unit;
    out << study.variables[free[i]].name << " = ";
    if (result.sd.empty()) {
      out << with_unit(result.point[i], unit, 6) << "\n";
      continue;
    }
    out << text_of(result.point[i], 6) << " +- " << with_unit(result.sd[i], unit, 3) << "  ("
        << text_of(result.lower[i], 6) << " to " << text_of(result.upper[i], 6) << " with "
        << text_of(100 * calibration.confidence) << " %)\n";
    for (std::size_t k = 0; k < i; ++k)
      out << "  correlation with " << study.variables[free[k]].name << " "
          << text_of(result.covariance[i][k] / (result.sd[i] * result.sd[k]), 3) << "\n";
  }
  out << (result.degrees_of_freedom > 0 ? "standard deviation of the noise: "
                                        : "root mean square of what is left: ")
      << text_of(result.noise, 4) << " of the given sd\n";
}

// What makes a variant another than the others: the values of its free variables, of the first few.
std::string row_text(const StudyFile& study, const Variant& variant) {
  constexpr std::size_t most = 4;
  std::string text = "variant " + std::to_string(variant.number);
  const std::vector<std::size_t> free = study.free_variables();
  for (std::size_t i = 0; i < std::min(most, free.size()); ++i) {
    const StudyVariable& variable = study.variables[free[i]];
    text +=
        (i == 0 ? ": " : ", ") + variable.name + " = " + with_unit(variant.values[free[i]], variable.unit, 6);
  }
  return text + (free.size() > most ? ", ..." : "");
}

// Where quantities are least and greatest, among the variants that are done.
void tell_ranges(std::ostream& out, const StudyFile& study, const std::vector<Variant>& variants) {
  std::vector<const Variant*> done;
  for (const Variant& variant : variants)
    if (variant.status == VariantStatus::done) done.push_back(&variant);
  if (done.empty()) return;
  for (std::size_t k = 0; k < study.quantities.size(); ++k) {
    const StudyQuantity& quantity = study.quantities[k];
    const auto [least, greatest] = std::ranges::minmax_element(
        done, {}, [k](const Variant* variant) { return variant->quantities[k]; });
    const auto told = [&](const Variant& variant) {
      return with_unit(variant.quantities[k], quantity.unit, 6) + " (" + row_text(study, variant) + ")";
    };
    out << quantity.name << "  " << told(**least) << " to " << told(**greatest) << "\n";
  }
}

}  // namespace

std::string study_plan_text(const StudyFile& study) {
  const std::size_t free = study.free_variables().size();
  std::ostringstream out;
  const std::size_t quantities = study.quantities.size();
  out << free << (free == 1 ? " variable that varies, " : " variables that vary, ")
      << study.variables.size() - free << " made of them, " << quantities
      << (quantities == 1 ? " quantity\n" : " quantities\n");
  std::visit(
      [&](const auto& task) {
        using Task = std::decay_t<decltype(task)>;
        if constexpr (std::is_same_v<Task, StudyPlan>)
          out << plan_points(study, task).size() << " variants\n";
        if constexpr (std::is_same_v<Task, StudySensitivity>)
          out << task.count * (static_cast<int>(free) + 2) << " variants for Sobol indices\n";
        if constexpr (std::is_same_v<Task, StudyReliability>)
          out << "at most about " << task.count << " variants for a probability\n";
        if constexpr (std::is_same_v<Task, StudyOptimum>)
          out << "at most about " << task.evaluations
              << (task.probabilities.empty()
                      ? " variants for an optimum\n"
                      : " designs for an optimum, each with some variants for each of " +
                            std::to_string(task.probabilities.size()) + " probabilities\n");
        if constexpr (std::is_same_v<Task, StudyCalibration>)
          out << "at most about " << task.evaluations << " variants for a calibration\n";
      },
      study.task);
  return out.str();
}

std::string answer_text(const StudyFile& study, const StudyResult& result) {
  std::ostringstream out;
  const bool is_plan = std::holds_alternative<std::monostate>(result.answer) ||
                       (std::holds_alternative<GradientResult>(result.answer) && result.variants.size() > 1);
  if (is_plan) tell_ranges(out, study, result.variants);
  std::visit([&](const auto& answer) { tell(out, study, answer); }, result.answer);
  const bool searched = std::holds_alternative<OptimumResult>(result.answer) ||
                        std::holds_alternative<CalibrationResult>(result.answer);
  if (const std::string undone = undone_text(result.variants); searched && !undone.empty())
    out << "  variants that are not done, of " << result.variants.size() << ": " << undone << "\n";
  for (const SurrogateResult& surrogate : result.surrogates)
    out << "surrogate of " << surrogate.quantity << "  Q2 " << text_of(surrogate.q2, 4) << "  largest error "
        << text_of(surrogate.largest_error, 3) << " at the variants held back\n";
  return out.str();
}

}  // namespace nurbeam
