#pragma once
#include <IGESData_IGESModel.hxx>
#include <vector>

#include "cad_import/program/remarks.h"
#include "cad_import/program/restated_curves.h"

namespace nurbeam {

/// That of restate_curves() for IGES: matrices before what they place, and offsets before arcs, as they refer
/// to the parameters of the arcs as these are in the file. Returns what scales.
std::vector<RestatedPlace> restate_iges(const IGESData_IGESModel& model, Remarks& remarks);

}  // namespace nurbeam
