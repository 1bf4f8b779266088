#pragma once
#include "nurbs/bezier_path.h"

namespace nurbeam {

/// The path with every corner of at most `angle` [rad] smoothed: both end tangents are turned into the
/// direction midway between them, about the shared point, which stays, as do the lengths of the control
/// polygon's legs. `deviation` grows by the measured largest distance from the given path. A path that ends
/// where it begins is not smoothed there.
BezierPath smooth_corners(const BezierPath& path, double angle);

}  // namespace nurbeam
