#pragma once
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>

#include "cad_import/files/child_process.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// Limits on one file and on the child process that reads it. Each MiB of the file adds 5 s to the time and
/// 24 MiB to the memory.
struct ImportOptions {
  std::size_t size_limit_bytes = std::size_t{512} << 20;  ///< of the file; a larger one is not opened
  std::chrono::seconds time_limit{28};                    ///< wall and CPU time
  std::size_t memory_limit_bytes = std::size_t{2} << 30;  ///< address space; 0: no limit (sanitizer builds)
  double tolerance = 1e-7;                                ///< for entities that have no exact NURBS form [m]
  std::function<bool()> interrupted = {};  ///< asked ten times a second; reading then ends with an error
  std::function<void(const ChildState&)> watch = {};  ///< told ten times a second how far the reader is
};

/// All curves of a STEP, IGES, DXF, BREP or JSON file (by its content, not its name): edges of shapes and
/// free curves, each once.
///
/// Read by OpenCASCADE in a child process under the limits; a crash, a time-out or an unreadable file is a
/// Diagnostic of severity error in the report (never an exception, never harm to this process). Every curve
/// is validated at the border (finite, non-decreasing knots, positive weights, length > 0). The order is that
/// of the file's shapes and the same in every run. Throws std::invalid_argument unless options.tolerance > 0.
ImportReport import_curves(const std::filesystem::path& file, const ImportOptions& options = {});

}  // namespace nurbeam
