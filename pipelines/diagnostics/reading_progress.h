#pragma once
#include <filesystem>
#include <iosfwd>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The curves of a CAD file, as import_curves() reads them. Where that takes longer than a second or two the
/// stream is told which share of the file it has read, as far as that is known, how long it has worked and
/// how much memory it holds: on a terminal one line that is rewritten, elsewhere a line each ten seconds; and
/// at the end what it took.
ImportReport read_with_progress(const std::filesystem::path& file, std::ostream& err);

}  // namespace nurbeam
