#pragma once
#include "nurbs/smooth/moebius_change.h"

namespace nurbeam::smooth {

/// The pieces of a path of at least one segment, with the lowest degree that they all have within the
/// tolerance, measured from the start of the path, so that a curve far from the origin keeps its digits.
Pieces lowest_pieces(const BezierPath& path, double tolerance);

/// A curve made of them, where the path lies.
NurbsCurve moved_from_start(const NurbsCurve& curve, const BezierPath& path);

}  // namespace nurbeam::smooth
