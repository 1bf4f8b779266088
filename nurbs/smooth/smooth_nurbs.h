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
/// A whole circle or ellipse is a cubic of six control points, C1 throughout. Else, in this order: every
/// piece is written with the lowest degree p that all have; pieces of one Bezier curve are rejoined;
/// neighbours that share their tangent get C1 in homogeneous coordinates, a knot of multiplicity p - 1, with
/// weights within 1:20, by the first of these ways that leaves full knots at corners only: lines linked to
/// the arcs beside them, changes of parameter (w_i -> c^i w_i), both with degree 3 where p is 2, and with
/// degree p + 1 linear factors without and with such changes. Where none does, that with the fewest full
/// knots is taken. At last the knots where the curve is C2 become simple. With CurveParameter::material the
/// parameter is left alone, and knots only lose what multiplicity they do not need in it.
///
/// tolerance [m] bounds the deviation of all that together; it must be well above the round-off of the
/// coordinates (1e-15 of the size), or nothing is found removable. Throws std::invalid_argument for an empty
/// path.
SmoothNurbs smooth_nurbs(const BezierPath& path, CurveParameter parameter, double tolerance);

}  // namespace nurbeam
