#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "nurbs/number_text.h"
#include "pipelines/case/case_overrides.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/study/analysis.h"
#include "pipelines/study/study_parts.h"

namespace nurbeam {

namespace {

// Or what is no expression, which has been said.
bool is_comparison(const std::string& text) {
  try {
    return Expression::parse(text).sides().has_value();
  } catch (const ExpressionError&) {
    return true;
  }
}

class StudyTaskReader : StudyPartReader {
 public:
  using StudyPartReader::StudyPartReader;

  void read_task() {
    if (has(json_, "plan")) study_.task = read_plan(json_["plan"]);
    if (has(json_, "sensitivity")) study_.task = read_sensitivity(json_["sensitivity"]);
    if (has(json_, "reliability")) study_.task = read_reliability(json_["reliability"]);
    if (has(json_, "optimise")) study_.task = read_optimum(json_["optimise"]);
    if (has(json_, "calibrate")) study_.task = read_calibration(json_["calibrate"]);
    if (!json_.contains("quantities") && !json_.contains("calibrate"))
      findings_.error("quantities", "is missing: what is asked of each variant");
    if (has(json_, "surrogate")) {
      const Json& json = json_["surrogate"];
      study_.surrogate =
          StudySurrogate{.kind = text(json, "type") == "kriging" ? StudySurrogate::Kind::kriging
                                                                 : StudySurrogate::Kind::chaos,
                         .degree = static_cast<int>(number(json, "degree", 3)),
                         .held_back = number(json, "held_back", 0.2)};
      check_enough_for_surrogate();
    }
    check_whole_numbers();
  }

 private:
  void check_enough_for_surrogate() {
    const auto* plan = std::get_if<StudyPlan>(&study_.task);
    if (!plan || findings_.has_errors()) return;  // of which the number of variants may be
    const std::size_t variants = variants_of(*plan);
    if (const std::string problem = too_few_for(*study_.surrogate, study_.free_variables().size(), variants);
        !problem.empty())
      findings_.error("surrogate", problem);
  }

  // Whether all variants have values that stand in the study, or at even distances.
  bool is_in_rows() const {
    using Way = StudyPlan::Kind;
    const auto* plan = std::get_if<StudyPlan>(&study_.task);
    return plan && (plan->kind == Way::list || plan->kind == Way::grid);
  }

  // What takes any values of a range comes to none that a whole number of the case can have.
  void check_whole_numbers() {
    const bool along_gradients = study_.derivatives && !study_.derivatives_where_known;
    if (is_in_rows() && !along_gradients) return;
    for (const std::size_t i : study_.free_variables()) {
      const StudyVariable& variable = study_.variables[i];
      const auto* numbers = variable.target ? std::get_if<CasePaths>(&*variable.target) : nullptr;
      if (!numbers) continue;
      for (const std::string& path : numbers->paths) {
        if (!dimension_at(path).whole) continue;
        const std::string where = child(variable.path, "path"),
                          is_whole = in_quotes(path) + " is a whole number, ",
                          cure =
                              "; take a \"plan\" with \"list\" or \"grid\", or give it a \"value\" of whole "
                              "numbers made of another variable, as \"4 + 2 * (x > 0.5)\"";
        if (along_gradients)
          findings_.error(where, is_whole + "by which nothing has a derivative" + cure);
        else
          findings_.warn(where, is_whole +
                                    "and any values of the range are tried: variants in which it is none "
                                    "are refused" +
                                    cure);
      }
    }
  }

  static std::size_t variants_of(const StudyPlan& plan) {
    if (plan.kind == StudyPlan::Kind::list) return plan.rows.size();
    if (plan.kind != StudyPlan::Kind::grid) return static_cast<std::size_t>(plan.count);
    return std::accumulate(plan.levels.begin(), plan.levels.end(), std::size_t{1}, std::multiplies<>());
  }

  StudyPlan read_plan(const Json& json) {
    using Way = StudyPlan::Kind;
    StudyPlan plan;
    const std::size_t free = study_.free_variables().size();
    if (has(json, "list")) read_list(json["list"], "plan.list", plan);
    if (has(json, "gradient")) {
      study_.derivatives = true;
      if (json["gradient"].is_array())
        read_list(json["gradient"], "plan.gradient", plan);
      else
        plan.rows = {study_.nominal()};
    }
    if (has(json, "grid")) {
      plan.kind = Way::grid;
      if (json["grid"].is_array())
        for (const double levels : numbers(json, "grid")) plan.levels.push_back(static_cast<int>(levels));
      else
        plan.levels.assign(free, json["grid"].get<int>());
      if (plan.levels.size() != free && all_named("variables"))
        findings_.error("plan.grid", "has " + std::to_string(plan.levels.size()) + " numbers for " +
                                         std::to_string(free) +
                                         " variables; give one for each, or one for all");
      const double variants =
          std::accumulate(plan.levels.begin(), plan.levels.end(), 1.0, std::multiplies<>());
      if (variants > 1e7)
        findings_.error("plan.grid", "makes " + text_of(variants) +
                                         " variants; at most 1e7: take fewer levels, or "
                                         "\"latin_hypercube\"");
      check_bounded("plan.grid");
    }
    for (const auto& [name, kind] : {std::pair{"latin_hypercube", Way::latin_hypercube},
                                     {"sobol", Way::sobol},
                                     {"monte_carlo", Way::monte_carlo}})
      if (has(json, name)) {
        plan.kind = kind;
        plan.count = static_cast<int>(number(json[name], "count", 1));
      }
    return plan;
  }

  void read_list(const Json& rows, const std::string& where, StudyPlan& plan) {
    const std::vector<std::size_t> free = study_.free_variables();
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const std::string path = child(where, r);
      if (rows[r].is_null()) continue;
      if (rows[r].size() != free.size()) {
        if (all_named("variables"))
          findings_.error(path, "has " + std::to_string(rows[r].size()) + " values for " +
                                    std::to_string(free.size()) + " variables");
        continue;
      }
      plan.rows.emplace_back();
      for (std::size_t k = 0; k < free.size(); ++k) {
        const StudyVariable& variable = study_.variables[free[k]];
        plan.rows.back().push_back(
            measured(rows[r][k], dimension_of(variable, variable.path), child(path, k)).value_or(0));
      }
    }
  }

  // A search and a grid need ends.
  void check_bounded(const std::string& path) {
    for (const std::size_t i : study_.free_variables()) {
      const StudyDistribution& d = study_.variables[i].distribution;
      const bool has_ends = d.kind == StudyDistribution::Kind::uniform ||
                            d.kind == StudyDistribution::Kind::triangular || (d.lower && d.upper);
      if (!has_ends)
        findings_.error(
            path, "needs a \"range\" of each variable, or a distribution with \"lower\" and \"upper\"; " +
                      in_quotes(study_.variables[i].name) + " has none");
    }
  }

  StudySensitivity read_sensitivity(const Json& json) {
    StudySensitivity sensitivity{.count = static_cast<int>(number(json, "count", 8)),
                                 .confidence = number(json, "confidence", 0.95)};
    for_each_item(json, "quantities", "sensitivity", [&](const Json& name, const std::string& path) {
      sensitivity.quantities.push_back(name.get<std::string>());
      check_quantity(sensitivity.quantities.back(), path);
      const auto last = sensitivity.quantities.end() - 1;
      if (std::find(sensitivity.quantities.begin(), last, *last) != last)
        findings_.error(path, in_quotes(*last) + " is named twice; name it once");
    });
    if (!has(json, "quantities")) sensitivity.quantities = names_of(study_.quantities);
    return sensitivity;
  }

  StudyReliability read_reliability(const Json& json) {
    using Method = StudyReliability::Method;
    StudyReliability r{.quantity = text(json, "quantity"), .fails_above = has(json, "above")};
    check_quantity(r.quantity, "reliability.quantity");
    const char* key = r.fails_above ? "above" : "below";
    if (has(json, key) && json[key].is_number())
      r.threshold = number(json, key);
    else if (has(json, key))
      findings_.error(child("reliability", key), "is a text; give the number in the unit of the quantity");
    r.method = chosen<Method>(json, "method",
                              {{"form", Method::form},
                               {"importance_sampling", Method::importance_sampling},
                               {"monte_carlo", Method::monte_carlo}});
    study_.derivatives = read_derivatives(json, "reliability", r.method == Method::form);
    r.count = static_cast<int>(number(json, "count", 1000));
    r.coefficient_of_variation = number(json, "coefficient_of_variation", 0);
    return r;
  }

  StudyOptimum read_optimum(const Json& json) {
    using Method = StudyOptimum::Method;
    StudyOptimum optimum;
    std::set<std::string> named;
    for (const auto& [key, minimise] : {std::pair{"minimise", true}, {"maximise", false}}) {
      if (!has(json, key)) continue;
      std::vector<std::string> names;
      if (json[key].is_string())
        names.push_back(text(json, key));
      else
        for (const Json& each : json[key])
          if (each.is_string()) names.push_back(each.get<std::string>());
      for (const std::string& name : names) {
        check_quantity(name, child("optimise", key));
        if (!named.insert(name).second)
          findings_.error(child("optimise", key), in_quotes(name) + " is named twice; name it once");
        optimum.objectives.push_back({name, minimise});
      }
    }
    if (!json.contains("minimise") && !json.contains("maximise"))
      findings_.error("optimise", "needs \"minimise\" or \"maximise\"");
    bool has_probabilities = false;  // also wrong ones
    for_each_item(json, "subject_to", "optimise", [&](const Json& item, const std::string& path) {
      const auto text = item.get<std::string>();
      const bool asks = asks_for_probability(text);
      has_probabilities = has_probabilities || asks;
      if (asks)
        read_probability(json_, text, path, optimum, study_, findings_);
      else
        read_inequality(text, path, optimum);
    });
    optimum.method = chosen<Method>(json, "method",
                                    {{"cobyla", Method::cobyla},
                                     {"nelder_mead", Method::nelder_mead},
                                     {"gradient", Method::gradient},
                                     {"genetic", Method::genetic}});
    if (has_probabilities && !has(json, "method")) optimum.method = Method::gradient;
    if (optimum.objectives.size() > 1) {
      if (has(json, "method") && optimum.method != Method::genetic)
        findings_.error("optimise.method", "with several objectives it must be \"genetic\"");
      optimum.method = Method::genetic;
    }
    if (optimum.method == Method::nelder_mead && has(json, "subject_to"))
      findings_.error("optimise.method",
                      "is \"nelder_mead\", which knows no \"subject_to\"; take \"cobyla\" or \"gradient\"");
    if (optimum.method == Method::cobyla || optimum.method == Method::gradient)
      for_each_no_comparison([&](const std::string& path, const std::string& is_none) {
        findings_.warn(path, is_none + ": else it may end before the optimum");
      });
    study_.derivatives =
        read_derivatives(json, "optimise", has_probabilities || optimum.method == Method::gradient);
    study_.derivatives_where_known = has_probabilities && !has(json, "derivatives");
    read_probability_check(json_, has_probabilities, optimum, study_, findings_);
    optimum.evaluations = static_cast<int>(number(json, "evaluations", 100));
    optimum.tolerance = number(json, "tolerance", 1e-4);
    if (has_probabilities)
      check_random_design(json_, optimum, study_, findings_);
    else
      check_bounded("optimise");
    return optimum;
  }

  // Whether variants come with derivatives, of a method that `needs` them or not.
  bool read_derivatives(const Json& json, const std::string& path, bool needs) {
    if (!needs && has(json, "derivatives"))
      findings_.error(child(path, "derivatives"), "has no use: the method takes no derivatives");
    return needs && (!has(json, "derivatives") || text(json, "derivatives") == "tangents");
  }

  // Of the constraints of variables: told(path, what is wrong with it for a search).
  void for_each_no_comparison(const std::function<void(const std::string&, const std::string&)>& told) {
    for_each_item(
        json_, "constraints", "",
        [&](const Json& item, const std::string& path) {
          const auto text = item.get<std::string>();
          if (is_comparison(text)) return;
          told(path,
               in_quotes(text) +
                   " is no comparison, of which a search does not know how far it is from holding; write it "
                   "as \"a + b <= 10\", several as one each");
        });
  }

  StudyCalibration read_calibration(const Json& json) {
    StudyCalibration calibration{.confidence = number(json, "confidence", 0.95),
                                 .evaluations = static_cast<int>(number(json, "evaluations", 200))};
    study_.derivatives = read_derivatives(json, "calibrate", true);
    study_.derivatives_where_known = !has(json, "derivatives");
    for_each_item(
        json, "observations", "calibrate",
        [&](const Json& item, const std::string& path) { read_observation(item, path, calibration); });
    for_each_no_comparison(
        [&](const std::string& path, const std::string& is_none) { findings_.error(path, is_none); });
    using Law = StudyDistribution::Kind;
    std::size_t normal = 0, uniform = 0;
    for (const std::size_t i : study_.free_variables()) {
      normal += study_.variables[i].distribution.kind == Law::normal ? 1 : 0;
      uniform += study_.variables[i].distribution.kind == Law::uniform ? 1 : 0;
    }
    for (const std::size_t i : study_.free_variables())
      if (const StudyVariable& v = study_.variables[i]; v.distribution.lower || v.distribution.upper)
        findings_.error(
            child(v.path, "distribution"),
            "has \"lower\" or \"upper\", which a calibration does not hold; leave them out, or give "
            "a \"range\" of each variable");
    const std::size_t free = study_.free_variables().size();
    calibration.prior = normal == free;
    if (normal != free && uniform != free)
      findings_.error(
          "calibrate",
          "needs a \"range\" of each variable, or of each a \"normal\" distribution, which is then "
          "what is known before");
    std::size_t measured = 0;
    for (const auto& observation : calibration.observations) measured += observation.times.size();
    if (measured <= free && calibration.observations.size() == json["observations"].size())
      findings_.error("calibrate.observations", "has " + std::to_string(measured) + " values for " +
                                                    std::to_string(free) + " variables; more are needed");
    return calibration;
  }

  void read_observation(const Json& json, const std::string& path, StudyCalibration& calibration) {
    StudyCalibration::Observation observation{
        .value = text(json, "value"), .path = path, .sd = number(json, "sd", 1)};
    if (!parsed(observation.value, child(path, "value")) || !has(json, "measured")) return;
    for (const auto& [time, value] : time_table(json, "measured")) {
      observation.times.push_back(time);
      observation.measured.push_back(value);
      const std::string at = text_of(time, all_digits);
      study_.quantities.push_back({observation.value + " at " + at + " s", "", path,
                                   Expression::parse("at(" + at + ", " + observation.value + ")"), true});
    }
    calibration.observations.push_back(std::move(observation));
  }

  void read_inequality(const std::string& source, const std::string& path, StudyOptimum& optimum) {
    const std::size_t sign = source.find_first_of("<>");
    if (sign == std::string::npos || source.find_first_of("<>", sign + 1) != std::string::npos)
      return findings_.error(path, in_quotes(source) + " is no inequality; write it as \"speed <= 10\"");
    const bool less = source[sign] == '<';
    const std::size_t behind = sign + (sign + 1 < source.size() && source[sign + 1] == '=' ? 2 : 1);
    const std::string left = source.substr(0, sign), right = source.substr(behind);
    std::vector<std::string> known = names_of(study_.variables);
    for (const StudyQuantity& quantity : study_.quantities) known.push_back(quantity.name);
    for (const std::string& side : {left, right}) {
      const auto expression = parsed(side, path);
      if (!expression) return;
      if (check_names(*expression, path, "quantity or variable", known)) check_number(*expression, path);
    }
    optimum.constraints.push_back(
        {Expression::parse(less ? right : left), Expression::parse(less ? left : right), source});
  }
};

}  // namespace

void read_study_task(const Json& json, StudyFile& study, Findings& findings) {
  StudyTaskReader(json, study, findings).read_task();
}

}  // namespace nurbeam
