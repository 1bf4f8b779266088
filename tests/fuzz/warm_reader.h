#pragma once
#include <chrono>
#include <cstddef>
#include <string>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The report that import_curves() gives of the file, made in a child forked from this process, in which
/// OpenCASCADE is loaded already: a tenth of the time that a program of its own takes. The same limits hold
/// and the same words are said. For a process without other threads.
ImportReport warm_report(const std::string& file, std::chrono::seconds time, std::size_t memory_bytes);

}  // namespace nurbeam
