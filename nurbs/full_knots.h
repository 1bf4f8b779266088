#pragma once
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The curves of a spline whose knots may stand degree + 1 times or more often inside, as in a chain of
/// Bezier curves: it is split there, and joined where the ends meet within 1e-9 of its size. Control points
/// that no part of the curve depends on, beside knots that stand more often than that, are left out.
/// control_points: 4 x (knots - degree - 1), homogeneous. Throws std::invalid_argument as KnotVector and
/// NurbsCurve do.
std::vector<NurbsCurve> split_at_full_knots(int degree, const std::vector<double>& knots,
                                            const Eigen::Matrix4Xd& control_points);

}  // namespace nurbeam
