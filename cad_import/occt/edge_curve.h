#pragma once
#include "cad_import/report/import_report.h"

class TopoDS_Edge;

namespace nurbeam {

/// The trimmed 3D curve of an edge [mm in, m out], in world coordinates, run through in the sense of the
/// edge; name and `free` are left for the caller. Lines, conics, Bezier and B-spline curves exactly, degree
/// kept; anything else as a cubic within `tolerance` [m] with the measured deviation. Throws
/// std::runtime_error or std::invalid_argument when the edge has no curve that is a valid NurbsCurve of
/// finite, positive length.
ImportedCurve imported_curve(const TopoDS_Edge& edge, double tolerance);

}  // namespace nurbeam
