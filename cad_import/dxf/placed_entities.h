#pragma once
#include "cad_import/dxf/dxf_entities.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// Adds the curves of the model space of a drawing to the report, those of its blocks where these stand, and
/// what is to be said of them. Throws std::runtime_error for blocks that place too many entities.
void add_placed_entities(const DxfDrawing& drawing, ImportReport& report);

}  // namespace nurbeam
