#pragma once
#include "fem/element/reference_curve.h"

namespace nurbeam {

/// What bends a beam into its drawing whose stress-free shape has no curvature.
struct DrawnBending {
  double energy = 0;     ///< of bending, as drawn [J]
  double curvature = 0;  ///< the largest of the drawing [1/m]
  double s = 0;          ///< where, in reference arc length [m]
};

/// That of a drawn curve which is not straightened, with the bending stiffness EI [N m^2].
DrawnBending drawn_bending(const ReferenceCurve& drawn, double bending_stiffness);

}  // namespace nurbeam
