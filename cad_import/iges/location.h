#pragma once
#include <Eigen/Geometry>

class IGESData_IGESEntity;
class IGESData_TransfEntity;

namespace nurbeam {

/// Where the transformation (124) of an entity puts it, in the unit of the file; nowhere else where what its
/// directory entry names as one is none.
Eigen::Affine3d location_of(const IGESData_IGESEntity& entity);

/// The same. Throws std::runtime_error
/// where that neither turns nor mirrors only: OpenCASCADE would leave radii and offsets as they were.
Eigen::Affine3d rigid_location(const IGESData_IGESEntity& entity);

/// What a transformation matrix (124) does together with those that its directory entry goes on to: these act
/// on what it gives (IGES 5.3, 4.21); in the unit of the file. OpenCASCADE takes the first alone. Throws
/// std::runtime_error where they come back to one of them, or are more than 100.
Eigen::Affine3d chained_location(const IGESData_TransfEntity& matrix);

/// Makes the matrix this one, which goes on to no other.
void set_matrix(IGESData_TransfEntity& matrix, const Eigen::Affine3d& location);

/// Gives the entity this transformation instead of its own.
void set_location(IGESData_IGESEntity& entity, const Eigen::Affine3d& location);

}  // namespace nurbeam
