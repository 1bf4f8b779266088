#pragma once
#include "pipelines/case/case_json.h"

namespace nurbeam {

/// Applies --set path=value texts; what is wrong with them goes to `wrong`.
void apply_overrides(Json& root, const std::vector<std::string>& overrides, std::vector<Diagnostic>& wrong);

}  // namespace nurbeam
