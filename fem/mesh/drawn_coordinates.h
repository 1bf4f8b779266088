#pragma once
#include <Eigen/Core>

#include "fem/mesh/mesh.h"

namespace nurbeam {

/// (mesh.coordinate_count) The places of moving nodes and of points where the plan has them; all others zero.
Eigen::VectorXd planned_places(const Mesh& mesh);

/// Position of a connector's end in the drawing, 3 [m].
Eigen::Vector3d drawn_place(const Structure& structure, const Grip& end);

/// The coordinates of the drawn shape, (mesh.coordinate_count).
Eigen::VectorXd drawn_coordinates(const Structure& structure, const Mesh& mesh);

}  // namespace nurbeam
