#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "cad_import/report/diagnostic.h"

namespace nurbeam {

/// "note", "warning" or "error".
std::string severity_name(Severity severity);

/// One line each: "error: where: message".
void print_diagnostics(std::ostream& stream, const std::vector<Diagnostic>& diagnostics);

}  // namespace nurbeam
