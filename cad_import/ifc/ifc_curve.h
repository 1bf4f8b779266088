#pragma once
#include <string>
#include <vector>

#include "cad_import/ifc/ifc_model.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The curves that an instance is, one after another, in the file's unit and its own coordinates: polylines
/// and indexed ones, lines, circles and ellipses that are trimmed or whole, B-splines, composite curves, and
/// alignments of lines, arcs and spirals with their grade. The knots of all but alignments are the parameters
/// that IFC counts, moved to begin anywhere. Throws std::runtime_error that says why where it is none of
/// them. `tolerance`: of what is approximated, in the file's unit.
std::vector<ImportedCurve> ifc_curves(const IfcModel& model, int instance, double tolerance);

/// Those that an alignment without a representation describes by its segments; none where it has none.
std::vector<ImportedCurve> ifc_alignment(const IfcModel& model, int alignment, double tolerance);

/// Whether ifc_curves() knows its kind.
bool is_ifc_curve(std::string_view keyword);

}  // namespace nurbeam
