#include "pipelines/diagnostics/print_diagnostics.h"

#include <ostream>

namespace nurbeam {

std::string severity_name(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      return "error";
  }
  return {};
}

void print_diagnostics(std::ostream& stream, const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics) {
    stream << severity_name(diagnostic.severity) << ": " << diagnostic.where << ": " << diagnostic.message
           << '\n';
  }
}

}  // namespace nurbeam
