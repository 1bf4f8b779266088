#include "pipelines/study/study_parts.h"

#include <algorithm>
#include <limits>

#include "nurbs/number_text.h"
#include "pipelines/case/case_overrides.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/utf8_text.h"

namespace nurbeam {
namespace {

Dimension dimension_of_value(CurveTransform::Kind kind) {
  switch (kind) {
    case CurveTransform::Kind::translate:
    case CurveTransform::Kind::place:
      return Dimension::length;
    case CurveTransform::Kind::rotate:
      return Dimension::angle;
    case CurveTransform::Kind::scale:
      return Dimension::number;
  }
  return Dimension::number;
}

}  // namespace

std::optional<Expression> StudyPartReader::parsed(const std::string& source, const std::string& path) {
  try {
    return Expression::parse(source);
  } catch (const ExpressionError& problem) {
    constexpr std::size_t longest = 200;
    const std::size_t before = character_count(source.substr(0, problem.offset));
    findings_.error(path, in_quotes(first_characters(source, longest)) + ", character " +
                              std::to_string(before + 1) + ": " + problem.what());
    return {};
  }
}

Expression StudyPartReader::parsed_or_zero(const std::string& source, const std::string& path) {
  return parsed(source, path).value_or(Expression::parse("0"));
}

bool StudyPartReader::all_named(const char* key) const {
  const Json& all = part(json_, key);
  return std::all_of(all.begin(), all.end(),
                     [](const Json& each) { return !each.is_null() && has(each, "name"); });
}

bool StudyPartReader::check_names(const Expression& expression, const std::string& path,
                                  const std::string& what, const std::vector<std::string>& known) {
  bool all_known = true;
  for (const std::string& name : expression.names()) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    all_known = false;
    if (all_named("variables") && all_named("quantities"))
      findings_.error(path, "there is no " + what + " " + in_quotes(name) + known_names(name, known));
  }
  return all_known;
}

void StudyPartReader::check_number(const Expression& expression, const std::string& path) {
  try {
    expression.number({.value = [](const std::string&) -> ExpressionValue { return 1.0; }});
  } catch (const std::invalid_argument& problem) {
    findings_.error(path, in_quotes(expression.text()) + ": " + problem.what() +
                              "; histories and events are there only for \"quantities\" of a \"case\"");
  }
}

std::optional<double> StudyPartReader::measured(const Json& value, Dimension dimension,
                                                const std::string& path) {
  if (value.is_null()) return {};
  if (value.is_number()) return value.get<double>();
  const ParsedQuantity quantity = parse_quantity(value.get<std::string>(), dimension);
  if (!quantity.value) findings_.error(path, quantity.error);
  return quantity.value;
}
std::vector<double> StudyPartReader::all_measured(const Json& values, Dimension dimension,
                                                  const std::string& path) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < values.size(); ++i)
    numbers.push_back(
        measured(values[i], dimension, child(path, i)).value_or(std::numeric_limits<double>::quiet_NaN()));
  return numbers;
}

void StudyPartReader::check_increasing(const std::vector<double>& values, const std::string& path) {
  for (std::size_t i = 0; i + 1 < values.size(); ++i)
    if (values[i] >= values[i + 1])  // what is no number has its own message
      return findings_.error(path, text_of(values[i], all_digits) + " is not below " +
                                       text_of(values[i + 1], all_digits) + "; values must increase");
}

Dimension StudyPartReader::dimension_of(const StudyVariable& variable, const std::string& path) {
  if (!variable.target) return Dimension::number;
  if (const auto* paths = std::get_if<CasePaths>(&*variable.target)) {
    std::optional<Dimension> dimension;
    for (const std::string& each : paths->paths) {
      const DimensionAtPath found = dimension_at(each);
      if (!found.dimension)
        findings_.error(child(path, "path"), in_quotes(each) + ": " + found.problem);
      else if (dimension && *dimension != *found.dimension)
        findings_.error(child(path, "path"), "one value cannot be a " + dimension_name(*dimension) +
                                                 " and a " + dimension_name(*found.dimension) + " (" + each +
                                                 ")");
      else
        dimension = found.dimension;
    }
    return dimension.value_or(Dimension::number);
  }
  if (std::holds_alternative<ControlPointCoordinate>(*variable.target)) return Dimension::length;
  if (const auto* transform = std::get_if<CurveTransform>(&*variable.target))
    return dimension_of_value(transform->kind);
  return Dimension::number;
}

void StudyPartReader::check_quantity(const std::string& name, const std::string& path) {
  const std::vector<std::string> known = names_of(study_.quantities);
  if (name.empty() || !all_named("quantities")) return;  // which has its message
  if (std::find(known.begin(), known.end(), name) == known.end())
    findings_.error(path, "there is no quantity " + in_quotes(name) + known_names(name, known));
}

}  // namespace nurbeam
