#include "pipelines/study/study_output.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "cad_import/files/atomic_file.h"
#include "nurbs/number_text.h"
#include "pipelines/results/checked_json.h"
#include "pipelines/results/file_hash.h"
#include "pipelines/results/netcdf_file.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;

void write_text(const std::filesystem::path& file, const std::string& text) {
  for (const Diagnostic& d : write_at_once(file, text)) throw std::runtime_error(d.where + ": " + d.message);
}

std::string heading(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

// Quoted where commas or quotes would divide it.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' ? ' ' : c;
  }
  return quoted + "\"";
}

Json named(const StudyFile& study, const std::vector<double>& free) {
  Json object = Json::object();
  const std::vector<double> values = all_values(study, free);
  for (std::size_t i = 0; i < study.variables.size(); ++i) object[study.variables[i].name] = values[i];
  return object;
}

Json to_json(const SobolIndices::Index& index) {
  return {{"value", index.value}, {"lower", index.lower}, {"upper", index.upper}};
}

Json answer_json(const StudyFile&, std::monostate) { return nullptr; }

// The derivatives of each variant: of each quantity, by each free variable.
Json answer_json(const StudyFile& study, const GradientResult& result) {
  Json json = {{"gradients", Json::array()}};
  const std::vector<std::size_t> free = study.free_variables();
  for (const Variant& variant : result.variants) {
    Json gradient;
    for (std::size_t k = 0; k < variant.gradient.size(); ++k)
      for (std::size_t i = 0; i < free.size(); ++i)
        gradient[study.quantities[k].name][study.variables[free[i]].name] = variant.gradient[k][i];
    json["gradients"].push_back({{"number", variant.number}, {"gradient", gradient}});
  }
  return json;
}

Json answer_json(const StudyFile& study, const SensitivityResult& result) {
  Json json = {{"rows_left_out", result.rows_left_out}};
  const std::vector<std::size_t> free = study.free_variables();
  for (const SobolIndices& indices : result.indices)
    for (std::size_t i = 0; i < free.size(); ++i)
      json["sobol_indices"][indices.quantity][study.variables[free[i]].name] = {
          {"first_order", to_json(indices.first_order[i])}, {"total_order", to_json(indices.total_order[i])}};
  return json;
}

Json answer_json(const StudyFile& study, const ReliabilityResult& result) {
  Json json = {{"probability", result.probability}, {"not_done", result.not_done}};
  if (result.coefficient_of_variation) json["coefficient_of_variation"] = *result.coefficient_of_variation;
  if (result.reliability_index) json["reliability_index"] = *result.reliability_index;
  if (!result.design_point.empty()) json["design_point"] = named(study, result.design_point);
  const std::vector<std::size_t> free = study.free_variables();
  for (std::size_t i = 0; i < result.importance.size(); ++i)
    json["importance"][study.variables[free[i]].name] = result.importance[i];
  return json;
}

Json answer_json(const StudyFile& study, const OptimumResult& result) {
  Json json = {{"optima", Json::array()}};
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    Json quantities = Json::object();
    for (std::size_t k = 0; k < study.quantities.size(); ++k)
      quantities[study.quantities[k].name] = result.quantities[i][k];
    json["optima"].push_back({{"variables", named(study, result.points[i])}, {"quantities", quantities}});
  }
  if (result.cut_off) json["evaluations_used_up"] = true;
  if (!result.not_converged.empty()) json["not_converged"] = result.not_converged;
  for (const double best : result.history)
    json["history"].push_back(std::isfinite(best) ? Json(best) : Json());
  return json;
}

Json answer_json(const StudyFile& study, const CalibrationResult& result) {
  const auto& calibration = std::get<StudyCalibration>(study.task);
  const std::vector<std::size_t> free = study.free_variables();
  Json json = {{"confidence", calibration.confidence}, {"noise", result.noise}};
  if (result.degrees_of_freedom > 0) json["degrees_of_freedom"] = result.degrees_of_freedom;
  for (std::size_t i = 0; i < free.size(); ++i) {
    Json& estimate = json["estimates"][study.variables[free[i]].name];
    estimate = {{"value", result.point[i]}};
    if (result.sd.empty()) continue;
    estimate["sd"] = result.sd[i];
    estimate["lower"] = result.lower[i];
    estimate["upper"] = result.upper[i];
  }
  json["variables"] = named(study, result.point);
  if (!result.active.empty()) json["active_constraints"] = result.active;
  if (!result.covariance.empty()) json["covariance"] = result.covariance;
  std::size_t at = 0;
  while (at < study.quantities.size() && !study.quantities[at].observed) ++at;
  for (const StudyCalibration::Observation& observation : calibration.observations) {
    const auto begin = result.quantities.begin() + static_cast<std::ptrdiff_t>(at);
    at += observation.times.size();
    const auto end = result.quantities.begin() + static_cast<std::ptrdiff_t>(at);
    json["observations"].push_back({{"value", observation.value},
                                    {"times", observation.times},
                                    {"measured", observation.measured},
                                    {"run", std::vector<double>(begin, end)}});
  }
  return json;
}

Json to_json(const StudyFile& study, const SurrogateResult& surrogate) {
  Json json = {
      {"quantity", surrogate.quantity}, {"q2", surrogate.q2}, {"largest_error", surrogate.largest_error}};
  const std::vector<std::size_t> free = study.free_variables();
  for (std::size_t i = 0; i < surrogate.first_order.size(); ++i)
    json["sobol_indices"][study.variables[free[i]].name] = {{"first_order", surrogate.first_order[i]},
                                                            {"total_order", surrogate.total_order[i]}};
  return json;
}

void tell(std::ostream&, const StudyFile&, std::monostate) {}

void tell(std::ostream& out, const StudyFile& study, const GradientResult& result) {
  const std::vector<std::size_t> free = study.free_variables();
  for (const Variant& variant : result.variants)
    for (std::size_t k = 0; k < variant.gradient.size(); ++k) {
      const StudyQuantity& quantity = study.quantities[k];
      out << quantity.name << " = " << text_of(variant.quantities[k], 8) << " " << quantity.unit << "\n";
      for (std::size_t i = 0; i < free.size(); ++i)
        out << "  by " << study.variables[free[i]].name << "  " << text_of(variant.gradient[k][i], 8) << "\n";
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
    out << "  " << study.variables[free[i]].name << " = " << text_of(result.design_point[i], 6)
        << " at the design point"
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

void tell(std::ostream& out, const StudyFile& study, const OptimumResult& result) {
  constexpr std::size_t most_lines = 20;
  out << (result.points.size() > 1 ? std::to_string(result.points.size()) + " points of the Pareto front\n"
                                   : std::string("best variant\n"));
  for (std::size_t i = 0; i < std::min(most_lines, result.points.size()); ++i) {
    const std::vector<double> values = all_values(study, result.points[i]);
    for (std::size_t k = 0; k < values.size(); ++k)
      out << "  " << study.variables[k].name << " = " << text_of(values[k], 8);
    for (std::size_t k = 0; k < study.quantities.size(); ++k)
      out << "  " << study.quantities[k].name << " = " << text_of(result.quantities[i][k], 8);
    out << "\n";
  }
  if (result.points.size() > most_lines)
    out << "  the first " << most_lines << " of them, by the first objective; study.json has all\n";
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
    out << study.variables[free[i]].name << " = " << text_of(result.point[i], 6);
    if (result.sd.empty()) {
      out << "\n";
      continue;
    }
    out << " +- " << text_of(result.sd[i], 3) << "  (" << text_of(result.lower[i], 6) << " to "
        << text_of(result.upper[i], 6) << " with " << text_of(100 * calibration.confidence) << " %)\n";
    for (std::size_t k = 0; k < i; ++k)
      out << "  correlation with " << study.variables[free[k]].name << " "
          << text_of(result.covariance[i][k] / (result.sd[i] * result.sd[k]), 3) << "\n";
  }
  out << (result.degrees_of_freedom > 0 ? "standard deviation of the noise: "
                                        : "root mean square of what is left: ")
      << text_of(result.noise, 4) << " of the given sd\n";
}

}  // namespace

void write_study_table(const std::filesystem::path& file, const StudyFile& study, const StudyResult& result) {
  std::ostringstream out;
  out.precision(17);
  const auto [number, status, wall_time, reason] = study_table_columns;
  out << number;
  for (const StudyVariable& variable : study.variables) out << "," << cell(variable.name);
  for (const StudyQuantity& quantity : study.quantities)
    out << "," << cell(heading(quantity.name, quantity.unit));
  out << "," << status << "," << wall_time << "," << reason << "\n";
  for (const Variant& variant : result.variants) {
    out << variant.number;
    for (const double value : variant.values) out << "," << value;
    for (std::size_t k = 0; k < study.quantities.size(); ++k) {
      out << ",";
      if (!variant.quantities.empty()) out << variant.quantities[k];
    }
    out << "," << name_of(variant.status) << "," << text_of(variant.seconds, 4) << "," << cell(variant.reason)
        << "\n";
  }
  write_text(file, out.str());
}

void write_study_netcdf(const std::filesystem::path& file, const StudyFile& study,
                        const StudyResult& result) {
  const std::size_t count = result.variants.size();
  try {
    NetcdfFile out = NetcdfFile::create(temporary_name(file));
    out.put_attribute("", "title", study.name);
    out.put_attribute("", "source", "nurbeam " NURBEAM_VERSION);
    out.define_dimension("variant", count);
    std::vector<std::pair<std::string, std::vector<double>>> columns;
    const auto add = [&](const std::string& name, const std::string& unit, const std::string& meaning,
                         auto value) {
      out.define(name, NetcdfFile::Type::real, {"variant"}, unit, meaning, std::max<std::size_t>(1, count));
      std::vector<double> values;
      for (const Variant& variant : result.variants) values.push_back(value(variant));
      columns.emplace_back(name, std::move(values));
    };
    for (std::size_t i = 0; i < study.variables.size(); ++i)
      add("variable_" + study.variables[i].name, "1", "variable",
          [i](const Variant& v) { return v.values[i]; });
    for (std::size_t k = 0; k < study.quantities.size(); ++k)
      add(
          "quantity_" + study.quantities[k].name,
          study.quantities[k].unit.empty() ? "1" : study.quantities[k].unit, study.quantities[k].value.text(),
          [k](const Variant& v) {
            return v.quantities.empty() || !std::isfinite(v.quantities[k]) ? NetcdfFile::fill
                                                                           : v.quantities[k];
          });
    add("wall_time", "s", "wall time", [](const Variant& v) { return v.seconds; });
    std::vector<std::string> statuses, reasons;
    for (const Variant& variant : result.variants) {
      statuses.push_back(name_of(variant.status));
      reasons.push_back(variant.reason);
    }
    out.define_texts("status", "variant", "how the variant ended", statuses);
    out.define_texts("reason", "variant", "why the variant is not done", reasons);
    for (const auto& [name, values] : columns)
      if (count > 0) out.put(name, {0}, {count}, values.data());
    out.close();
  } catch (const std::runtime_error&) {
    std::error_code ignored;
    std::filesystem::remove(temporary_name(file), ignored);
    throw;
  }
  publish(file);
}

std::string study_summary(const StudyFile& study, const StudyResult& result) {
  Json counts = Json::object();
  double seconds = 0;
  for (const Variant& variant : result.variants) {
    const std::string status = name_of(variant.status);
    counts[status] = counts.value(status, 0) + 1;
    seconds += variant.seconds;
  }
  Json json = {
      {"nurbeam", NURBEAM_VERSION},
      {"name", study.name},
      {"status", result.interrupted ? "interrupted" : (result.failure.empty() ? "done" : result.failure)},
      {"variants", counts},
      {"wall time of all variants [s]", seconds},
      {"answer", std::visit([&](const auto& answer) { return answer_json(study, answer); }, result.answer)},
      {"surrogates", Json::array()},
      {"study", Json::parse(study.json)}};
  for (const SurrogateResult& surrogate : result.surrogates)
    json["surrogates"].push_back(to_json(study, surrogate));
  return json.dump(2) + "\n";
}

void write_study_summary(const std::filesystem::path& file, const StudyFile& study, const StudyResult& result,
                         const std::filesystem::path& table) {
  Json json = Json::parse(study_summary(study, result));
  json["files"] = {{{"file", table.filename().string()}, {"sha256", sha256_of_file(table)}}};
  write_text(file, with_checksum(json.dump()));
}

std::string study_plan_text(const StudyFile& study) {
  const std::size_t free = study.free_variables().size();
  std::ostringstream out;
  out << free << " variables that vary, " << study.variables.size() - free << " made of them, "
      << study.quantities.size() << " quantities\n";
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
          out << "at most about " << task.evaluations << " variants for an optimum\n";
        if constexpr (std::is_same_v<Task, StudyCalibration>)
          out << "at most about " << task.evaluations << " variants for a calibration\n";
      },
      study.task);
  return out.str();
}

std::string answer_text(const StudyFile& study, const StudyResult& result) {
  std::ostringstream out;
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
