#pragma once
#include <Eigen/Core>
#include <array>

namespace nurbeam {

/// Weights (k_0, k_1, k_2, 1) of Eqs. 31-38 of Ding & Ouyang: the minimum-norm change from ones that leads
/// the merged curve through r_H at parameter u; all ones if any is not positive. Pseudo-inverse tolerance
/// 1e-2 (relative). Vectors of `dimension` 2 or 3 (of three components, the third 0 in the plane); slope_a,
/// slope_b: dr/du at the ends [m].
std::array<double, 4> merged_weights(int dimension, const Eigen::Vector3d& r_a,
                                     const Eigen::Vector3d& slope_a, const Eigen::Vector3d& r_b,
                                     const Eigen::Vector3d& slope_b, const Eigen::Vector3d& r_h, double u);

}  // namespace nurbeam
