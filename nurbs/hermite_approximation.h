#pragma once
#include <vector>

#include "nurbs/nurbs_curve.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// A cubic in place of the part of a curve on [start, end].
struct CubicPart {
  RationalCubic cubic;
  double start, end;  ///< parameters of the source
  double deviation;   ///< bound on the distance from the source at equal parameters [m]
};

/// The fewest cubics within `tolerance` [m] > 0 of a curve of any degree, their deviations as even as that
/// number allows: each has the homogeneous end values and end derivatives of the source on its interval. They
/// reach across the source's knots but for those where it is only C0; where tangents differ there by less
/// than 1e-4 rad, which is no corner, both are turned midway if the tolerance allows. The deviation is proven
/// from Bezier points of the difference; a tolerance below the round-off of the coordinates is not reached,
/// and it tells so.
std::vector<CubicPart> hermite_approximation(const NurbsCurve& curve, double tolerance);

}  // namespace nurbeam
