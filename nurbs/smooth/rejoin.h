#pragma once
#include "nurbs/smooth/moebius_change.h"

namespace nurbeam::smooth {

/// The same curve with the same weight at both ends.
Points balanced(Points points);

/// The pieces with those of one Bezier curve made one again, as far as the logarithm of the ratio of its
/// weights, when it is written with this degree, stays within `widest`.
Pieces rejoined(const Pieces& pieces, Eigen::Index degree, CurveParameter parameter, double widest,
                double tolerance);

}  // namespace nurbeam::smooth
