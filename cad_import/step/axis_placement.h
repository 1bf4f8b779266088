#pragma once
#include <Eigen/Geometry>
#include <StepGeom_Axis2Placement3d.hxx>

namespace nurbeam {

/// Gives the placement the axes that ISO 10303-42 (build_axes) gives it where it leaves them out. OpenCASCADE
/// chooses another first axis, and takes a piece of a conic for the whole where it has none.
void complete_axes(StepGeom_Axis2Placement3d& placement);

/// Where it puts what is drawn about the origin; lengths in the unit of the file. Precondition: its axes are
/// complete. Throws std::runtime_error where it has no origin in space or its axes are parallel.
Eigen::Affine3d place_of(const StepGeom_Axis2Placement3d& placement);

/// That of such a place.
opencascade::handle<StepGeom_Axis2Placement3d> axis_placement(const Eigen::Affine3d& place);

}  // namespace nurbeam
