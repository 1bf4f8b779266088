#pragma once
#include <Eigen/Geometry>

class IGESData_IGESEntity;

namespace nurbeam {

/// Where the transformation (124) of an entity puts it, in the unit of the file. Throws std::runtime_error
/// where that neither turns nor mirrors only: OpenCASCADE would leave radii and offsets as they were.
Eigen::Affine3d rigid_location(const IGESData_IGESEntity& entity);

/// Gives the entity this transformation instead of its own.
void set_location(IGESData_IGESEntity& entity, const Eigen::Affine3d& location);

}  // namespace nurbeam
