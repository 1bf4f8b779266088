#pragma once
#include <string>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The report as bytes, for a process on the same machine; doubles bit by bit.
std::string to_bytes(const ImportReport& report);

/// The inverse of to_bytes. Throws std::runtime_error when the bytes are not those of a report, and
/// std::invalid_argument when they hold a curve that cannot exist.
ImportReport report_from_bytes(const std::string& bytes);

}  // namespace nurbeam
