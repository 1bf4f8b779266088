#pragma once
#include <XSControl_Reader.hxx>
#include <unordered_set>

#include "cad_import/program/entity_origins.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// Entities of the file; only ever looked up, so that no order depends on addresses.
using Recovered = std::unordered_set<const Standard_Transient*>;

/// Looks for the curves of the file that are in no edge and no face that OpenCASCADE made: supplemental
/// geometry, wireframes, rational Bezier curves, degrees above 25, negative radii, poly loops. In STEP those
/// are added to the report that have a value of their own and a place, that is where the file has no assembly
/// and one length unit, and in IGES hyperbolas (104); a warning names each of the others. Returns those
/// added.
Recovered add_lost_curves(const XSControl_Reader& reader, double tolerance, ImportReport& report);

}  // namespace nurbeam
