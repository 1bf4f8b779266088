#include "pipelines/study/study_parts.h"

#include <algorithm>
#include <limits>

#include "nurbs/number_text.h"
#include "pipelines/case/case_overrides.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

std::optional<Expression> StudyPartReader::parsed(const std::string& source, const std::string& path) {
  try {
    return Expression::parse(source);
  } catch (const ExpressionError& problem) {
    findings_.error(path, in_quotes(source) + ", character " + std::to_string(problem.offset + 1) + ": " +
                              problem.what());
    return {};
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
  const auto* transform = std::get_if<CurveTransform>(&*variable.target);
  return transform && transform->kind == CurveTransform::Kind::translate ? Dimension::length
                                                                         : Dimension::number;
}

void StudyPartReader::check_quantity(const std::string& name, const std::string& path) {
  const std::vector<std::string> known = names_of(study_.quantities);
  if (std::find(known.begin(), known.end(), name) == known.end())
    findings_.error(path, "there is no quantity " + in_quotes(name) + known_names(name, known));
}

}  // namespace nurbeam
