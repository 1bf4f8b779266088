#pragma once
#include <Eigen/Core>

#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// A circular arc from the origin along +x, turning left by twice a half angle [rad]: the conic with weights
/// 1, c cos(half angle), c^2 raised to degree 3. |r'(1)| = |r'(0)|/c^2; c = 1 is the arc in even steps.
RationalCubic raised_arc(double radius, double half_angle, double c);

/// Where it ends.
Eigen::Vector3d arc_end(double radius, double half_angle);

}  // namespace nurbeam
