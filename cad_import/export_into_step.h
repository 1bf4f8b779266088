#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "cad_import/report/request.h"

namespace nurbeam {

/// Writes `source`, a STEP file, to `file` with its curves in their deformed shape: assembly, names, colours
/// and all else stay as they are, in the source's own unit and text.
///
/// Of a free curve only the geometry is exchanged, in the instance that styles and layers are attached to. An
/// edge that bounds faces cannot move without them, nor a curve of which another one is made: there the
/// deformed curve is added to the same part, without style, and a warning says so. A part that is placed
/// several times shows the shape at every place (a warning). The source is read in a child process as by
/// import_curves(); when that fails, a drawn curve is not in it, or the file cannot be written, nothing is
/// written and a Diagnostic of severity error says why. Written to a temporary name and renamed.
[[nodiscard]] std::vector<Diagnostic> export_into_step(const std::filesystem::path& source,
                                                       const std::filesystem::path& file,
                                                       const std::vector<DeformedCurve>& curves);

}  // namespace nurbeam
