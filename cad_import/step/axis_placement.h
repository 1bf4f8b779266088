#pragma once
#include <StepGeom_Axis2Placement3d.hxx>

namespace nurbeam {

/// Gives the placement the axes that ISO 10303-42 (build_axes) gives it where it leaves them out. OpenCASCADE
/// chooses another first axis, and takes a piece of a conic for the whole where it has none.
void complete_axes(StepGeom_Axis2Placement3d& placement);

}  // namespace nurbeam
