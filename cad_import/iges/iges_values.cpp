#include "cad_import/iges/iges_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>

namespace nurbeam {
namespace {

using Values = std::vector<std::string>;

/// Those of a kind whose number of values is always the same.
const std::map<int, std::size_t> fixed_counts{{100, 7}, {104, 11}, {108, 4}, {110, 6},  {116, 3},  {118, 4},
                                              {120, 4}, {122, 4},  {123, 3}, {124, 12}, {130, 14}, {140, 5},
                                              {142, 5}, {190, 2},  {192, 3}, {194, 4},  {196, 2},  {198, 4},
                                              {408, 4}, {412, 10}, {414, 8}};

std::size_t whole_number(const Values& values, std::size_t at) {
  constexpr double most = 1e8;
  const std::string& value = at < values.size() ? values[at] : "";
  const std::optional<double> number = iges_number(value);
  if (!number || *number != std::floor(*number) || *number < 0 || *number > most)
    throw std::runtime_error("value " + std::to_string(at + 1) + " is '" + value +
                             "'; it must be a whole number that is not negative");
  return static_cast<std::size_t>(*number);
}

std::size_t of_copious_data(const Values& values) {
  const std::size_t kind = whole_number(values, 0), points = whole_number(values, 1);
  if (kind < 1 || kind > 3) throw std::runtime_error("value 1 is '" + values[0] + "'; it must be 1, 2 or 3");
  return kind == 1 ? 3 + 2 * points : 2 + (kind == 2 ? 3 : 6) * points;
}

std::size_t of_spline(const Values& values) {
  const std::size_t last = whole_number(values, 0), degree = whole_number(values, 1);
  return 6 + (last + degree + 2) + 4 * (last + 1);
}

std::size_t of_spline_surface(const Values& values) {
  const std::size_t last_u = whole_number(values, 0), last_v = whole_number(values, 1);
  const std::size_t degree_u = whole_number(values, 2), degree_v = whole_number(values, 3);
  return 9 + (last_u + degree_u + 2) + (last_v + degree_v + 2) + 4 * (last_u + 1) * (last_v + 1) + 4;
}

/// An associativity that is a list of entities.
bool is_group(const IgesRecord& record) {
  return record.type == 402 &&
         (record.form == 1 || record.form == 7 || record.form == 14 || record.form == 15);
}

/// How many values the kind needs, all of which are numbers; 0: it is not known.
std::size_t needed(const IgesRecord& record, const Values& values) {
  switch (record.type) {
    case 102:
    case 402:
      return record.type == 102 || is_group(record) ? 1 + whole_number(values, 0) : 0;
    case 106:
      return of_copious_data(values);
    case 112: {
      const std::size_t pieces = whole_number(values, 3);
      return 4 + pieces + 1 + 12 * pieces;
    }
    case 126:
      return of_spline(values);
    case 128:
      return of_spline_surface(values);
    default: {
      const auto known = fixed_counts.find(record.type);
      return known == fixed_counts.end() ? 0 : known->second;
    }
  }
}

/// Values that are lost inside a B-spline move others to where its range V(0) to V(1) is told, of a file that
/// has not all that may stand there.
std::optional<std::string> lost_before_range(const IgesRecord& record, const Values& values,
                                             std::size_t needed) {
  constexpr std::size_t range = 2, normal = 3;
  if (record.type != 126 || values.size() < needed + range || values.size() >= needed + range + normal)
    return std::nullopt;
  const std::optional<double> first = iges_number(values[needed]), last = iges_number(values[needed + 1]);
  if (first && last && *first < *last) return std::nullopt;
  return "where its range V(0) to V(1) must stand is '" + values[needed] + "' to '" + values[needed + 1] +
         "': values before it are lost";
}

std::string quoted(const std::string& value) {
  constexpr std::size_t longest = 20;
  return "'" + (value.size() > longest ? value.substr(0, longest) + "..." : value) + "'";
}

}  // namespace

std::string iges_kind(int type) {
  static const std::map<int, const char*> known{{100, "CircularArc"},
                                                {102, "CompositeCurve"},
                                                {104, "ConicArc"},
                                                {106, "CopiousData"},
                                                {108, "Plane"},
                                                {110, "Line"},
                                                {112, "SplineCurve"},
                                                {116, "Point"},
                                                {118, "RuledSurface"},
                                                {120, "SurfaceOfRevolution"},
                                                {122, "TabulatedCylinder"},
                                                {123, "Direction"},
                                                {124, "TransformationMatrix"},
                                                {126, "BSplineCurve"},
                                                {128, "BSplineSurface"},
                                                {130, "OffsetCurve"},
                                                {140, "OffsetSurface"},
                                                {142, "CurveOnSurface"},
                                                {308, "SubfigureDef"},
                                                {402, "Group"},
                                                {408, "SingularSubfigure"},
                                                {412, "RectArraySubfigure"},
                                                {414, "CircArraySubfigure"}};
  const auto kind = known.find(type);
  return kind == known.end() ? "entity " + std::to_string(type) : kind->second;
}

std::optional<double> iges_number(const std::string& value) {
  if (value.empty()) return 0;
  std::string text = value;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
  const bool has_plus = text[0] == '+' && text.find_first_of("+-", 1) != 1,
             is_numeral = text.find_first_not_of("0123456789+-.Ee") == std::string::npos;
  double number = 0;
  const auto [end, error] = std::from_chars(text.data() + has_plus, text.data() + text.size(), number);
  if (!is_numeral || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<std::string> values_defect(const IgesRecord& record, const Values& values) {
  std::size_t count = 0;
  try {
    count = needed(record, values);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  for (std::size_t i = 0; i < std::min(count, values.size()); ++i)
    if (!iges_number(values[i]))
      return "value " + std::to_string(i + 1) + " is " + quoted(values[i]) + ", which is no number";
  if (const auto lost = lost_before_range(record, values, count)) return lost;
  if (values.size() < count)
    return "it has " + std::to_string(values.size()) + " of the " + std::to_string(count) +
           " values that its kind needs";
  return std::nullopt;
}

std::size_t empty_numbers(const IgesRecord& record, const Values& values) {
  // How many whole numbers stand before the first number of each kind.
  static const std::map<int, std::size_t> first_numbers{{106, 2}, {112, 4}, {126, 6}};
  const auto first = first_numbers.find(record.type);
  if (first == first_numbers.end()) return 0;
  const std::size_t last = std::min(needed(record, values), values.size());
  std::size_t count = 0;
  for (std::size_t i = first->second; i < last; ++i) count += values[i].empty() ? 1 : 0;
  return count;
}

std::vector<std::size_t> parts_in(const IgesRecord& record, const Values& values) {
  std::vector<std::size_t> places;
  const auto list = [&](std::size_t count_at) {
    const std::optional<double> count =
        count_at < values.size() ? iges_number(values[count_at]) : std::nullopt;
    for (std::size_t i = count_at + 1;
         count && static_cast<double>(i - count_at) <= *count && i < values.size(); ++i)
      places.push_back(i);
  };
  if (record.type == 102 || is_group(record)) list(0);
  if (record.type == 308) list(2);
  if ((record.type == 130 || record.type == 408 || record.type == 412 || record.type == 414) &&
      !values.empty())
    places.push_back(0);
  return places;
}

}  // namespace nurbeam
