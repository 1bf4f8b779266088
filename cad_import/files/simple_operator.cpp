#include "cad_import/files/simple_operator.h"

#include <map>

#include "cad_import/files/complex_instance.h"

namespace nurbeam {

std::optional<std::string> simple_operator(std::string_view value) {
  constexpr const char* keyword = "CARTESIAN_TRANSFORMATION_OPERATOR_3D";
  value = without_blanks(value);
  if (!value.starts_with('(') || value.find(keyword) == std::string_view::npos) return std::nullopt;
  std::map<std::string_view, std::string_view> parts;
  for (const auto& [part, parameters] : parts_of(value)) parts.emplace(part, parameters);
  std::string simple = keyword;
  char before = '(';
  // The outermost supertype's parameters come first.
  for (const char* part : {"REPRESENTATION_ITEM", "FUNCTIONALLY_DEFINED_TRANSFORMATION",
                           "CARTESIAN_TRANSFORMATION_OPERATOR", keyword}) {
    if (parts[part].empty()) return std::nullopt;
    (simple += before) += parts[part];
    before = ',';
    parts.erase(part);
  }
  parts.erase("GEOMETRIC_REPRESENTATION_ITEM");  // has none
  if (!parts.empty()) return std::nullopt;
  return simple + ')';
}

}  // namespace nurbeam
