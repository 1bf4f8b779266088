#pragma once
#include <XSControl_Reader.hxx>
#include <cstddef>
#include <unordered_map>
#include <unordered_set>

#include "cad_import/program/entity_origins.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// Curve entities that OpenCASCADE made nothing of; only ever looked up, so that no order depends on
/// addresses.
struct LostCurves {
  std::unordered_map<const Standard_Transient*, std::size_t>
      recovered;                                        ///< index of the first curve in the report
  std::unordered_set<const Standard_Transient*> named;  ///< in a warning

  bool contain(const Standard_Transient* entity) const {
    return recovered.contains(entity) || named.contains(entity);
  }
};

/// Looks for the curves of the file that are in no edge and no face that OpenCASCADE made: supplemental
/// geometry, wireframes, rational Bezier curves, degrees above 25, negative radii, poly loops. In STEP those
/// are added to the report that have a value of their own and a place, that is where the file has no assembly
/// and one length unit, and in IGES hyperbolas (104) and the copies of arrays (412, 414); a warning names
/// each of the others.
LostCurves add_lost_curves(const XSControl_Reader& reader, double tolerance, ImportReport& report);

}  // namespace nurbeam
