#include "cad_import/report/diagnostic.h"

#include <algorithm>

namespace nurbeam {

bool has_errors(const std::vector<Diagnostic>& diagnostics) {
  const auto is_error = [](const Diagnostic& diagnostic) { return diagnostic.severity == Severity::error; };
  return std::any_of(diagnostics.begin(), diagnostics.end(), is_error);
}

}  // namespace nurbeam
