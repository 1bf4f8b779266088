#pragma once
#include <Eigen/Core>
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// Degree 1, its knots counting the places.
NurbsCurve polyline_through(const std::vector<Eigen::Vector3d>& places);

/// centre + cos(t) a + sin(t) b from t = from to from + sweep, in quarters, as a rational quadratic.
NurbsCurve conic_arc(const Eigen::Vector3d& centre, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                     double from, double sweep);

/// The arc over this chord that is bulge / 2 of it high, to the right of a positive bulge (the tangent of a
/// quarter of its angle), which is not 0, about a normal of length 1: by chords from its start, so that it
/// meets both ends however flat it is.
NurbsCurve arc_over_chord(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double bulge,
                          const Eigen::Vector3d& normal);

}  // namespace nurbeam
