#pragma once
#include <string>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The curves of a JSON file (docs/cad.md, "JSON of curves"). A warning names each that is damaged, and each
/// key that is not known. Throws std::runtime_error for a text that is no JSON, or that has no list of
/// curves.
ImportReport read_json(const std::string& content);

}  // namespace nurbeam
