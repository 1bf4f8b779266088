#pragma once
#include <string>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The curves of a DXF drawing (text form, AutoCAD 12 to 2018), in metres: LINE, ARC, CIRCLE, ELLIPSE, SPLINE
/// and (LW)POLYLINE of the section ENTITIES, exactly; a polyline with bulges as its lines and arcs. Those of
/// layers that are frozen or off are hidden, those of the paper space left out with a warning. The unit is
/// $INSUNITS, millimetres where that is missing (a warning). A warning names each entity that cannot be
/// read. Throws std::runtime_error for a file that is no list of pairs of group code and value.
ImportReport read_dxf(const std::string& content);

}  // namespace nurbeam
