#pragma once
#include <string>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The curves of an IFC file with this content (IFC2X3 to IFC4X3), where its products stand: alignments, axes
/// and other curves, and the centre lines of swept disks and of circles extruded or revolved, with their
/// radii. Other items are counted in a note; a warning names each curve that is not read. What is
/// approximated lies within `tolerance` [m]. The places of the diagnostics do not name the file.
ImportReport read_ifc(const std::string& content, double tolerance);

}  // namespace nurbeam
