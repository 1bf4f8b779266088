#pragma once
#include "pipelines/case/case_json.h"

namespace nurbeam {

/// What a value at a path did to a case.
struct AppliedOverride {
  std::string problem;  ///< "" where the case has been changed
  std::string path;     ///< of the value, items of arrays by their number: beams[0].section.radius
};
/// Null removes the key or the item; [+] behind a list appends an item to it, and makes the list where there
/// is none. The case is as it was where there is a problem.
AppliedOverride set_value(Json& root, const std::string& path, const Json& value);
/// The same of a path=value text.
AppliedOverride apply_override(Json& root, const std::string& text);
/// Applies --set path=value texts; what is wrong with them goes to `wrong`.
void apply_overrides(Json& root, const std::vector<std::string>& overrides, std::vector<Diagnostic>& wrong);

/// What the number at a path of the case file measures, or why there is none there.
struct DimensionAtPath {
  std::optional<Dimension> dimension;
  std::string problem;  ///< empty when there is one
  bool whole = false;   ///< only whole numbers can stand there
};
/// Of a path as --set has it; items of arrays are not looked up.
DimensionAtPath dimension_at(const std::string& path);

}  // namespace nurbeam
