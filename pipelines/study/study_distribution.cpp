#include <algorithm>
#include <limits>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/study/analysis.h"
#include "pipelines/study/study_parts.h"

namespace nurbeam {

namespace {

using LawKind = StudyDistribution::Kind;

constexpr std::pair<const char*, LawKind> laws[] = {
    {"uniform", LawKind::uniform},       {"normal", LawKind::normal}, {"lognormal", LawKind::lognormal},
    {"triangular", LawKind::triangular}, {"gumbel", LawKind::gumbel}, {"weibull", LawKind::weibull}};

bool is_positive(LawKind law) { return law == LawKind::lognormal || law == LawKind::weibull; }
bool has_moments(LawKind law) { return law != LawKind::uniform && law != LawKind::triangular; }

ExpressionScope scope_of(const StudyFile& study, const std::string& moved = "", double to = 0) {
  return {.value = [&study, moved, to](const std::string& name) -> ExpressionValue {
    if (name == moved) return to;
    for (const StudyVariable& variable : study.variables)
      if (variable.name == name) return variable.nominal;
    return std::numeric_limits<double>::quiet_NaN();
  }};
}

/// Reads one distribution.
class DistributionReader : StudyPartReader {
 public:
  DistributionReader(const Json& whole, Dimension dimension, StudyVariable& variable, StudyFile& study,
                     Findings& findings)
      : StudyPartReader(whole, study, findings), dimension_(dimension), d_(variable.distribution) {
    for (const StudyVariable& earlier : study.variables)
      if (!earlier.derived && !earlier.is_random) designs_.push_back(earlier.name);
  }

  void read(const Json& json, const std::string& path) {
    for (const auto& [name, law] : laws) {
      if (!has(json, name)) continue;
      d_.kind = law;
      const std::string where = child(path, name);
      if (json[name].is_array())
        read_ends(json[name], where);
      else
        read_moments(json[name], where);
    }
    const std::size_t behind = d_.parameters.size();
    if (has(json, "lower")) d_.lower = parameter(json["lower"], child(path, "lower"), behind);
    if (has(json, "upper")) d_.upper = parameter(json["upper"], child(path, "upper"), behind + 1);
    if (d_.lower && d_.upper) check_increasing({*d_.lower, *d_.upper}, child(path, "upper"));
  }

 private:
  void read_ends(const Json& ends, const std::string& path) {
    for (std::size_t i = 0; i < ends.size(); ++i)
      d_.parameters.push_back(parameter(ends[i], child(path, i), i));
    check_increasing(d_.parameters, path);
  }

  void read_moments(const Json& moments, const std::string& path) {
    if (!has(moments, "mean") || !has(moments, "sd")) return;
    d_.parameters = {parameter(moments["mean"], child(path, "mean"), 0),
                     parameter(moments["sd"], child(path, "sd"), 1)};
    if (!(d_.parameters[1] > 0)) must_be_positive(child(path, "sd"), d_.parameters[1]);
    if (is_positive(d_.kind) && !(d_.parameters[0] > 0))
      must_be_positive(child(path, "mean"), d_.parameters[0]);
  }

  void must_be_positive(const std::string& path, double value) {
    findings_.error(path, "is " + text_of(value, all_digits) + "; must be greater than 0");
  }

  // A number, a text with a unit, or an expression of design variables: then its value at their nominal ones.
  double parameter(const Json& value, const std::string& path, std::size_t place) {
    if (value.is_string() && !parse_quantity(value.get<std::string>(), dimension_).value)
      if (const auto formula = formula_of(value.get<std::string>())) {
        if (!check_names(*formula, path, "earlier variable with a \"range\"", designs_)) return 1;
        check_number(*formula, path);
        d_.formulas.push_back({place, *formula});
        return findings_.has_errors() ? 1 : formula->number(scope_of(study_));
      }
    return measured(value, dimension_, path).value_or(0);
  }

  static std::optional<Expression> formula_of(const std::string& text) {
    try {
      Expression formula = Expression::parse(text);
      return formula.names().empty() ? std::nullopt : std::optional(std::move(formula));
    } catch (const ExpressionError&) {
      return {};
    }
  }

  Dimension dimension_;
  StudyDistribution& d_;
  std::vector<std::string> designs_;
};

// "its sd is -1": why numbers make no distribution; empty where they do.
std::string problem_of(const StudyDistribution& d) {
  const std::vector<double>& p = d.parameters;
  if (has_moments(d.kind)) {
    if (!(p[1] > 0)) return "its sd is " + text_of(p[1], 6);
    if (is_positive(d.kind) && !(p[0] > 0)) return "its mean is " + text_of(p[0], 6);
  } else {
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
      if (!(p[i] < p[i + 1])) return text_of(p[i], 6) + " is not below " + text_of(p[i + 1], 6);
  }
  return mean_of(d) ? "" : "it has nothing between \"lower\" and \"upper\"";
}

// At both ends of the range of each design variable, the others nominal.
void check_over_ranges(const StudyFile& study, const StudyVariable& random, Findings& findings) {
  for (const StudyVariable& design : study.variables) {
    if (design.derived || design.is_random) continue;
    for (const double end : design.distribution.parameters)
      if (const std::string problem = problem_of(random.distribution.at(scope_of(study, design.name, end)));
          !problem.empty())
        return findings.error(child(random.path, "distribution"),
                              "is none with " + design.name + " = " + text_of(end, 6) + ": " + problem +
                                  "; narrow the \"range\" of " + in_quotes(design.name));
  }
}

}  // namespace

StudyDistribution StudyDistribution::at(const ExpressionScope& design) const {
  StudyDistribution found = *this;
  found.formulas.clear();
  for (const auto& [place, value] : formulas) {
    const double number = value.number(design);
    if (place < parameters.size())
      found.parameters[place] = number;
    else
      (place == parameters.size() ? found.lower : found.upper) = number;
  }
  return found;
}

void read_study_distribution(const Json& whole, const Json& json, Dimension dimension,
                             StudyVariable& variable, StudyFile& study, Findings& findings) {
  variable.is_random = true;
  DistributionReader(whole, dimension, variable, study, findings)
      .read(json, child(variable.path, "distribution"));
}

bool stands_alone_in(const Json& distribution, const std::string& variable) {
  if (distribution.is_string()) {
    const auto text = distribution.get<std::string>();
    return text == variable || text == "'" + variable + "'";
  }
  return distribution.is_structured() &&
         std::any_of(distribution.begin(), distribution.end(),
                     [&](const Json& part) { return stands_alone_in(part, variable); });
}

double middle_of(const StudyDistribution& d) {
  const std::vector<double>& p = d.parameters;
  if (p.size() < 2) return 0;
  double mean = p[0];
  if (d.kind == LawKind::uniform) mean = (p[0] + p[1]) / 2;
  if (d.kind == LawKind::triangular) mean = (p[0] + p[1] + p[2]) / 3;
  return d.lower || d.upper ? mean_of(d).value_or(mean) : mean;
}

void check_ends(const StudyVariable& variable, Findings& findings) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const StudyDistribution& d = variable.distribution;
  const std::vector<double>& p = d.parameters;
  if (p.size() < 2) return;
  double from = -none, to = none;
  if (!has_moments(d.kind)) from = p.front(), to = p.back();
  if (is_positive(d.kind)) from = 0;
  const double lower = std::max(d.lower.value_or(-none), from), upper = std::min(d.upper.value_or(none), to);
  if (!(lower < upper) || !mean_of(d))
    return findings.error(child(variable.path, "distribution"),
                          "has nothing between \"lower\" and \"upper\"");
  if (variable.nominal < lower || variable.nominal > upper)
    findings.error(child(variable.path, "nominal"), "is " + text_of(variable.nominal, all_digits) +
                                                        ", outside of " + text_of(lower, all_digits) +
                                                        " to " + text_of(upper, all_digits));
}

void check_formulas(const StudyFile& study, Findings& findings) {
  if (findings.has_errors()) return;
  for (const StudyVariable& variable : study.variables) {
    if (variable.distribution.formulas.empty()) continue;
    if (study.has_random_design())
      check_over_ranges(study, variable, findings);
    else
      findings.error(child(variable.path, "distribution"),
                     "names other variables (" + in_quotes(variable.distribution.formulas[0].value.text()) +
                         "), which only \"optimise\" with a \"probability(...)\" in \"subject_to\" looks "
                         "for; give numbers");
  }
}

}  // namespace nurbeam
