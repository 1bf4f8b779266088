#include "pipelines/model/curve_choice.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <set>

#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

using Property = std::string ImportedCurve::*;

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::vector<std::string> different(const ImportReport& report, Property property) {
  std::set<std::string> values;
  for (const ImportedCurve& curve : report.curves)
    if (!(curve.*property).empty()) values.insert(curve.*property);
  return {values.begin(), values.end()};
}

// Why no curve has the property; the file may have none at all of the kind.
std::string without(const std::string& key, const std::string& value, const ImportReport& report,
                    Property property) {
  const std::vector<std::string> known = different(report, property);
  if (known.empty()) return "is " + in_quotes(value) + ", but no curve of " + report.file + " has a " + key;
  return "no curve of " + report.file + " has the " + key + " " + in_quotes(value) +
         known_names(value, known);
}

// Whether the part's path is this one or ends with it.
bool is_in_part(const std::string& part, const std::string& asked) {
  return part == asked || part.ends_with("/" + asked);
}

}  // namespace

ChosenCurves chosen_curves(const CurveChoice& choice, const ImportReport& report) {
  ChosenCurves chosen{std::vector<int>(report.curves.size()), "", ""};
  std::iota(chosen.indices.begin(), chosen.indices.end(), 0);
  const auto narrow = [&](const std::string& key, const std::optional<std::string>& asked, Property property,
                          auto matches) {
    if (!asked || !chosen.error.empty()) return;
    std::erase_if(chosen.indices, [&](int i) { return !matches(report.curves[i].*property, *asked); });
    if (chosen.indices.empty()) chosen = {{}, key, without(key, *asked, report, property)};
  };
  narrow("part", choice.part, &ImportedCurve::part, is_in_part);
  narrow("layer", choice.layer, &ImportedCurve::layer, std::equal_to<>());
  narrow("colour", choice.colour, &ImportedCurve::colour,
         [](const std::string& colour, const std::string& asked) { return colour == lower_case(asked); });
  return chosen;
}

std::string what_chooses(const CurveChoice& choice, const ImportReport& report) {
  constexpr std::size_t most_listed = 10;
  std::string text;
  const auto add = [&](const char* key, const std::optional<std::string>& asked, Property property) {
    const std::vector<std::string> values = different(report, property);
    if (asked || values.size() < 2) return;
    text += std::string("; \"") + key + "\" chooses among ";
    for (std::size_t i = 0; i < std::min(values.size(), most_listed); ++i)
      text += (i > 0 ? ", " : "") + in_quotes(values[i]);
    if (values.size() > most_listed) text += ", ...";
  };
  add("layer", choice.layer, &ImportedCurve::layer);
  add("part", choice.part, &ImportedCurve::part);
  add("colour", choice.colour, &ImportedCurve::colour);
  return text;
}

}  // namespace nurbeam
