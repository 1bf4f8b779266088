#pragma once
#include <XSControl_Reader.hxx>
#include <cstddef>
#include <gp_Trsf.hxx>
#include <unordered_map>
#include <vector>

#include "cad_import/program/entity_origins.h"
#include "cad_import/program/restated_curves.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// One of them that a curve was added of, or several, which begin at this index in the report.
struct RecoveredCurve {
  std::size_t first;
  std::vector<gp_Trsf> places = {};  ///< of its part; none of an IGES array's
  std::size_t at_each = 0;           ///< curves at each place, one after another
};

/// Curve entities that OpenCASCADE made nothing of; only ever looked up, so that no order depends on
/// addresses.
struct LostCurves {
  std::unordered_map<const Standard_Transient*, RecoveredCurve> recovered;
  EntitySet named;  ///< in a warning

  bool contain(const Standard_Transient* entity) const {
    return recovered.contains(entity) || named.contains(entity);
  }
};

/// Looks for the curves of the file that are in no edge and no face that OpenCASCADE made: supplemental
/// geometry, wireframes, rational Bezier curves, degrees above 25, negative radii, poly loops. In STEP those
/// are added to the report that have a value of their own, in an assembly at each place of the part whose
/// shape they are in, in its unit, and in IGES the copies of arrays (412, 414); a warning names each of the
/// others, but for those that restate_curves() refused.
LostCurves add_lost_curves(const XSControl_Reader& reader, const RestatedCurves& restated, double tolerance,
                           ImportReport& report);

}  // namespace nurbeam
