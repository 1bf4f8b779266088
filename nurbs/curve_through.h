#pragma once
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// How a curve goes through points.
struct ThroughPoints {
  int degree = 3;
  /// Directions, whose length does not count: none, one at each end, or one at every point. Of degree 3.
  std::vector<Eigen::Vector3d> tangents = {};
  bool closed = false;  ///< smooth also where the end meets the start; the last point need not be the first
};

/// The smooth curve through points (3 x n [m]) in their order, exact at each. Its parameter is the length of
/// the chords, so that it has no waves where points are unevenly apart; knots are those of C. de Boor, "A
/// Practical Guide to Splines": the points' own for degree 3 (interpolated_cubic), averages of them for
/// others (The NURBS Book, Eq. 9.8). With a tangent at every point it is made of cubics with these tangents.
///
/// Throws std::invalid_argument, with the number of the point, for points that are not finite or equal to the
/// one before, for fewer points than degree + 1, and for tangents of another number or without a direction.
NurbsCurve curve_through(const std::vector<Eigen::Vector3d>& points, const ThroughPoints& how = {});

}  // namespace nurbeam
