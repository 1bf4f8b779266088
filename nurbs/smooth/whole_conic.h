#pragma once
#include <optional>

#include "nurbs/smooth/moebius_change.h"
#include "nurbs/smooth/smooth_nurbs.h"

namespace nurbeam::smooth {

/// The quadratics, if they make a whole ellipse or circle once around, as a cubic of six
/// control points: two half turns, C1 in homogeneous coordinates where they meet and of one speed at the
/// seam. Its parameter runs from `start` over `length`. Nothing for any other shape.
///
/// A half turn is (1 - u)^2 h0 + 2 u (1 - u) h1 + u^2 h2 with h0 = (c + a, 1), h1 = (b, 0), h2 = (c - a, 1):
/// c the centre, a and b conjugate half diameters. Times 3 - 2u its weights are 3, 1/3, 1, 1 times those of
/// h0 and h2, and the other one, times 1 + 2u, goes on from it with the same derivative.
std::optional<SmoothNurbs> whole_conic(const Pieces& pieces, double start, double length, double tolerance);

}  // namespace nurbeam::smooth
