#include "cad_import/report/import_report.h"

#include <algorithm>

namespace nurbeam {

bool has_errors(const std::vector<Diagnostic>& diagnostics) {
  const auto is_error = [](const Diagnostic& diagnostic) { return diagnostic.severity == Severity::error; };
  return std::any_of(diagnostics.begin(), diagnostics.end(), is_error);
}

}  // namespace nurbeam
