#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "cad_import/dxf/dxf_entities.h"

namespace nurbeam {

/// Where an INSERT puts the points of a block: scaled along the block's axes about its base point, turned,
/// and moved, in the coordinates that the INSERT's normal gives; once for each row and column of an array.
/// Throws std::runtime_error for more than 1e5 of them.
std::vector<Eigen::Affine3d> places_of(const DxfEntity& insert, const DxfBlock& block);

}  // namespace nurbeam
