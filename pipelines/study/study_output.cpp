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

// What a probability is, and how it changes with the design. An index that is not found is null.
Json to_json(const StudyFile& study, const ProbabilityResult& result) {
  Json json = {{"constraint", result.text}, {"least_reliability_index", result.least_index}};
  if (result.form.reliability_index) json.update(answer_json(study, result.form));
  json.erase("not_done");
  json.erase("importance");
  std::size_t random = 0, design = 0;
  for (const std::size_t i : study.free_variables()) {
    const StudyVariable& variable = study.variables[i];
    if (variable.is_random && random < result.form.importance.size())
      json["importance"][variable.name] = result.form.importance[random++];
    if (!variable.is_random && design < result.index_gradient.size())
      json["reliability_index_gradient"][variable.name] = result.index_gradient[design++];
  }
  if (!result.check) return json;
  json["check"] = {{"probability", result.check->probability}, {"not_done", result.check->not_done}};
  if (result.check->coefficient_of_variation)
    json["check"]["coefficient_of_variation"] = *result.check->coefficient_of_variation;
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
  for (const ProbabilityResult& probability : result.probabilities)
    json["probabilities"].push_back(to_json(study, probability));
  if (!result.doubts.empty()) json["doubts"] = result.doubts;
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

}  // namespace nurbeam
