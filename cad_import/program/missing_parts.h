#pragma once
#include <StepData_StepModel.hxx>

#include "cad_import/program/remarks.h"

class Interface_Graph;

namespace nurbeam {

/// Points and directions of STEP that a reference to nothing, or to another kind, leaves empty are filled
/// with zeros: OpenCASCADE crashes on them. Lines, polylines, splines and conics of them are refused, and
/// other placements named.
void fill_missing_parts(const StepData_StepModel& model, const Interface_Graph& graph, Remarks& remarks);

}  // namespace nurbeam
