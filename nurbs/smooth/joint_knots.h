#pragma once
#include "nurbs/smooth/moebius_change.h"

namespace nurbeam::smooth {

/// The curve of the pieces with the fewest knots that keep it within the tolerance.
SmoothNurbs with_fewest_knots(const Pieces& pieces, double start, double tolerance);

}  // namespace nurbeam::smooth
