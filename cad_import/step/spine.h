#pragma once
#include <TopoDS_Wire.hxx>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The curve as a wire [mm] of one edge for each of its spans, to be swept along: lines and arcs of circles
/// as what they are, so that their sweeps are cylinders and tori, and the others short enough for good
/// approximations. Throws std::runtime_error, naming the place, where the curve has a corner.
TopoDS_Wire spine(const NurbsCurve& curve);

}  // namespace nurbeam
