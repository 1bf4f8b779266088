#pragma once
#include <optional>

#include "nurbs/smooth/smooth_nurbs.h"

namespace nurbeam {

/// The path, if it is a whole circle or ellipse, as the quadratic arcs that its segments were cut from by
/// even changes of the parameter, joined by double knots at the breaks of the path; nothing where there are
/// more than four of them, and for any other shape. `tolerance` as in smooth_nurbs().
std::optional<SmoothNurbs> drawn_conic(const BezierPath& path, double tolerance);

}  // namespace nurbeam
