#pragma once
#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The same curve with a knot that stands `times` more among its knots (The NURBS Book, Eqs. 5.11 and 5.15,
/// in homogeneous coordinates). Throws std::invalid_argument (value and rule) unless u lies strictly inside
/// the curve, times is at least 1, and the knot then stands at most `degree` times.
NurbsCurve with_knot(const NurbsCurve& curve, double u, int times = 1);

}  // namespace nurbeam
