#pragma once
#include <vector>

#include "cad_import/report/diagnostic.h"

namespace nurbeam {

/// The diagnostics, with warnings and notes that say the same of several items of a list ("beams[0]...",
/// "beams[1]...") as one: that of the first item, which counts the others and names up to three of them.
std::vector<Diagnostic> joined_warnings(const std::vector<Diagnostic>& diagnostics);

}  // namespace nurbeam
