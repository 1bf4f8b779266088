#pragma once
#include <string>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The curves of the model space of a DXF drawing (text form, AutoCAD 12 to 2018), in metres: LINE, ARC,
/// CIRCLE, ELLIPSE, SPLINE, HELIX (the spline in it) and (LW)POLYLINE, exactly; a HELIX without a spline as
/// cubics; a polyline with bulges as its lines and arcs. Those of layers that are frozen or off are hidden,
/// those of the paper space left out with a warning. The unit is $INSUNITS, else that of $MEASUREMENT, else
/// millimetres (a warning). A warning names what cannot be read, a note the kinds that are not read and their
/// numbers. Throws std::runtime_error for a file that is no list of pairs of group code and value up to one
/// of EOF.
ImportReport read_dxf(const std::string& content);

}  // namespace nurbeam
