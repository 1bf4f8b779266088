#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cad_import/ifc/ifc_model.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// A round bar or pipe of a shape: its centre line, and its radii in the file's unit.
struct IfcPipe {
  std::vector<ImportedCurve> centre;
  double radius, bore = 0;
  std::string remark = {};  ///< how its directrix was taken, where that is not sure
};

/// A swept disk, or a circle extruded at right angles or revolved about an axis in its plane; nothing of any
/// other item. Throws std::runtime_error where it is damaged.
std::optional<IfcPipe> ifc_pipe(const IfcModel& model, int item, double tolerance);

}  // namespace nurbeam
