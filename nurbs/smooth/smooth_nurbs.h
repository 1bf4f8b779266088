#pragma once
#include "nurbs/bezier_path.h"

namespace nurbeam {

/// What the parameter of a curve made of a path is.
enum class CurveParameter {
  free,     ///< whatever gives the fewest control points
  material  ///< the path's: its breaks, where they stay knots, keep their parameter, and so does all between
};

/// A NURBS curve and a bound on its distance from what it was made of.
struct SmoothNurbs {
  NurbsCurve curve;
  double deviation;  ///< [m]: no point of either lies farther from the other; not sampled but proven (up to
                     ///< round-off) from the differences of homogeneous Bezier points
};

/// The path as one NURBS curve of the lowest exact degree with few control points.
///
/// In this order: every piece is written with the lowest degree p that all have (a whole conic, which is not
/// C1 in degree 2, with p = 3, if that takes no more control points); pieces of one Bezier curve are
/// rejoined; neighbours that share their tangent get C1 in homogeneous coordinates, a knot of multiplicity
/// p - 1, by a Moebius change of parameter of each (w_i -> c^i w_i) where a recursion has a positive solution
/// of mild weights, and a knot of multiplicity p, as in BezierPath::to_nurbs(), where it has none; at last
/// the knots where a cubic is C2 become simple. With CurveParameter::material the parameter is left alone,
/// and knots only lose what multiplicity they do not need in it.
///
/// tolerance [m] bounds the deviation of all that together; it must be well above the round-off of the
/// coordinates (1e-15 of the size), or nothing is found removable. Throws std::invalid_argument for an empty
/// path.
SmoothNurbs smooth_nurbs(const BezierPath& path, CurveParameter parameter, double tolerance);

}  // namespace nurbeam
