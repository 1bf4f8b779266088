#pragma once
#include <Eigen/Geometry>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// An ellipse of these semi-axes, or a part of it, anticlockwise from one angle of its parameter to a larger
/// one, at most a turn more, under a placement: a rational quadratic, exactly.
NurbsCurve conic_curve(const Eigen::Vector2d& radii, double first, double last, const Eigen::Affine3d& place);

}  // namespace nurbeam
