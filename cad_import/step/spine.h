#pragma once
#include <Geom_BSplineCurve.hxx>
#include <TopoDS_Wire.hxx>
#include <optional>
#include <string>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The curve as OpenCASCADE's [mm].
opencascade::handle<Geom_BSplineCurve> bspline(const NurbsCurve& curve);

/// The curve as a wire [mm] of one edge for each of its spans, to be swept along: lines and arcs of circles
/// as what they are, so that their sweeps are cylinders and tori, and the others short enough for good
/// approximations. One edge of all where it has a corner.
TopoDS_Wire spine(const NurbsCurve& curve);

/// The first corner of the curve in words, "a corner of 12 degrees at (1, 2, 3) m"; nothing of a smooth one.
std::optional<std::string> corner_of(const NurbsCurve& curve);

}  // namespace nurbeam
