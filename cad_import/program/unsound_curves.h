#pragma once
#include <Interface_Graph.hxx>
#include <StepData_StepModel.hxx>

#include "cad_import/program/remarks.h"

namespace nurbeam {

/// Refuses the curves of a STEP model that are made of themselves, nested more than 1000 deep, or placed by a
/// direction (0, 0, 0), or lack parts (missing_parts.h), and takes those in a circle out of the sets that
/// hold them: OpenCASCADE crashes on these, and takes standard axes for no direction. A warning names other
/// placements that have none.
void refuse_unsound_curves(const StepData_StepModel& model, const Interface_Graph& graph, Remarks& remarks);

}  // namespace nurbeam
