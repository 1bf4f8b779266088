#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/system/material_points.h"

namespace nurbeam {

/// How far a beam hangs below the straight line between its ends, at most, along `gravity`, whose size does
/// not count [m]; 0 where it is nowhere below. NaN without gravity, and where the ends lie above each other,
/// as those of a ring do. Precondition: there are elements.
/// The element whose middle is the lowest so, of those that sag looks at first.
int lowest_element(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity);
double sag(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity);

}  // namespace nurbeam
