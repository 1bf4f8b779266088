#include "cad_import/files/simple_spline.h"

#include <map>

#include "cad_import/files/complex_instance.h"

namespace nurbeam {

std::optional<std::string> simple_spline(std::string_view value) {
  value = without_blanks(value);
  if (!value.starts_with('(') || value.find("B_SPLINE_CURVE") == std::string_view::npos) return std::nullopt;
  std::map<std::string_view, std::string_view> parts;
  for (const auto& [keyword, parameters] : parts_of(value)) parts.emplace(keyword, parameters);
  const std::string_view curve = parts["B_SPLINE_CURVE"], name = parts["REPRESENTATION_ITEM"];
  for (const char* known :
       {"B_SPLINE_CURVE", "REPRESENTATION_ITEM", "BOUNDED_CURVE", "CURVE", "GEOMETRIC_REPRESENTATION_ITEM"})
    parts.erase(known);
  if (parts.size() != 1 || curve.empty() || name.empty()) return std::nullopt;
  const auto& [keyword, more] = *parts.begin();
  if (keyword != "BEZIER_CURVE" && keyword != "UNIFORM_CURVE" && keyword != "QUASI_UNIFORM_CURVE" &&
      keyword != "B_SPLINE_CURVE_WITH_KNOTS")
    return std::nullopt;
  std::string simple(keyword);
  ((simple += '(') += name) += ',';
  simple += curve;
  if (!more.empty()) (simple += ',') += more;
  return simple + ')';
}

}  // namespace nurbeam
