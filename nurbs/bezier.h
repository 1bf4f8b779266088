#pragma once
#include <Eigen/Core>
#include <utility>

namespace nurbeam {

/// Homogeneous Bezier points of any degree, 4 x (degree + 1): column i is (w_i P_i, w_i). The curve lives on
/// [0, 1].
using BezierPoints = Eigen::Matrix4Xd;

/// The part of a Bezier curve on [a, b], which may lie outside [0, 1].
BezierPoints part(const BezierPoints& points, double a, double b);

/// Both halves of a Bezier curve (de Casteljau).
std::pair<BezierPoints, BezierPoints> halves(BezierPoints points);

/// The same curve written with a degree that is not lower.
BezierPoints elevated(BezierPoints points, Eigen::Index degree);

/// Bound on the distance |a(u) - b(u)| [m] of two projected curves of one degree at equal parameters;
/// infinite when a weight of b, scaled to that of a at the start, is not positive.
///
/// With r = A/W and B/V: r - B/V = ((A - B) - r (W - V)) / V. The differences and V lie in the hulls of their
/// Bezier points, r in that of its control points, measured from its start. Each of `halvings` halvings of
/// both curves brings the bound closer to the largest distance.
double distance_bound(const BezierPoints& a, const BezierPoints& b, int halvings = 0);

}  // namespace nurbeam
