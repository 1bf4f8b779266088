#pragma once
#include <Eigen/Core>

#include "fem/mesh/mesh.h"

namespace nurbeam {

/// The coordinates of the drawn shape, (mesh.coordinate_count).
Eigen::VectorXd drawn_coordinates(const Structure& structure, const Mesh& mesh);

}  // namespace nurbeam
