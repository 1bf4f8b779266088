#pragma once
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The reports that import_curves() gives of the files, made one after another in a child forked from this
/// process, in which OpenCASCADE is loaded already: a hundredth of the time that programs of their own take.
/// The same words are said; `time` of the processor holds for each file, `memory_bytes` for all. A file that
/// ends the child is the last with a report where it is the first; else the one before it is, and it may be
/// read anew. For a process without other threads; `files` must not be empty.
std::vector<ImportReport> warm_reports(const std::vector<std::string>& files, std::chrono::seconds time,
                                       std::size_t memory_bytes);

/// Ends this process when it has used that much more processor time, to the second above.
void limit_processor_time(std::chrono::seconds time);

}  // namespace nurbeam
