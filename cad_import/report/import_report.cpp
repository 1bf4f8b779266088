#include "cad_import/report/import_report.h"

#include <algorithm>

namespace nurbeam {

bool ImportReport::ok() const {
  return std::none_of(
      diagnostics.begin(), diagnostics.end(),
      [](const Diagnostic& d) { return d.severity == Severity::error; });
}

}  // namespace nurbeam
