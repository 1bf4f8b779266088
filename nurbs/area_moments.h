#pragma once
#include <Eigen/Core>
#include <span>

#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// Moments of a region of the plane z = 0 about the origin.
struct AreaMoments {
  double area = 0;                                   ///< of the region [m^2]
  Eigen::Vector2d first = Eigen::Vector2d::Zero();   ///< integral of (x, y) [m^3]
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();  ///< integral of (x, y) (x, y)^T [m^4]

  AreaMoments& operator+=(const AreaMoments& other);
};

/// Moments of the region inside a closed row of cubics in the plane z = 0 (its z is not looked at), to about
/// 1e-14 of the region's extent; negative where the path runs clockwise, so that those of an outline and its
/// holes add up.
///
/// For f homogeneous of degree k: integral of f dA = 1/(k + 2) times that of f (x dy - y dx) along the
/// boundary (Green), by adaptive Gauss quadrature on every cubic.
AreaMoments area_moments(std::span<const RationalCubic> loop);

}  // namespace nurbeam
