#pragma once
#include <Eigen/Core>

#include "cad_import/dxf/dxf_entities.h"

namespace nurbeam {

/// The point of the groups `code`, `code` + 10 and `code` + 20, 0 where one is missing.
Eigen::Vector3d point_at(const DxfEntity& entity, int code);

/// The axes of the entity's own coordinates from its normal, by the "arbitrary axis algorithm" of the DXF
/// reference.
Eigen::Matrix3d own_axes(const DxfEntity& entity);

}  // namespace nurbeam
