#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// A vector that turns with the tangent of the beam, and its derivative in r_s.
struct TurnedVector {
  Eigen::Vector3d value;
  Eigen::Matrix3d gradient;
};

/// p turned by the smallest rotation that takes the drawn tangent to r_s / |r_s|. Undefined where the two are
/// opposite in space.
TurnedVector turned_with_tangent(const Eigen::Vector3d& p, const Eigen::Vector3d& drawn_tangent,
                                 const Eigen::Vector3d& rs);

}  // namespace nurbeam
