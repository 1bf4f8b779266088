#pragma once
#include <Standard_Transient.hxx>
#include <vector>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The curves of a STEP entity in its own coordinates, made without OpenCASCADE's translator of shapes:
/// B-splines and Bezier curves of any degree, rational or not, and poly loops; trimmed curves, whole conics,
/// polylines, and what an EDGE_CURVE bounds, as imported_curve() gives them. `unit`: its length unit [m].
/// Throws std::exception or Standard_Failure where it is no bounded curve or no valid one.
/// It is one but for B-splines that knots inside divide.
std::vector<ImportedCurve> step_curves(const opencascade::handle<Standard_Transient>& entity, double unit,
                                       double tolerance);

}  // namespace nurbeam
