#pragma once
#include <Eigen/Geometry>
#include <Standard_Handle.hxx>

class StepGeom_CartesianTransformationOperator3d;

namespace nurbeam {

/// What the operator does, with its scale and mirror, which OpenCASCADE leaves out; its origin in
/// OpenCASCADE's unit, from the unit that this goes by. Throws std::runtime_error where its scale is not
/// positive or its axes do not span space.
Eigen::Affine3d place_of(const StepGeom_CartesianTransformationOperator3d& transformation);

/// Whether OpenCASCADE reads the operator as it is meant: all its axes are given, and it neither scales nor
/// mirrors. Throws as place_of() does.
bool is_location(const StepGeom_CartesianTransformationOperator3d& transformation);

/// An operator that moves and turns so; the origin in the unit of the file.
opencascade::handle<StepGeom_CartesianTransformationOperator3d> transformation_operator(
    const Eigen::Affine3d& place);

}  // namespace nurbeam
