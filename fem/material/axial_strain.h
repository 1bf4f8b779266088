#pragma once

namespace nurbeam {

/// The part of the axial strain eps = (|r_s|^2 - 1)/2 of an element that carries axial stiffness.
enum class AxialStrain {
  ends_and_mean,  ///< the quadratic with the ends' values and the mean of eps (assumed_axial.h)
  pointwise       ///< eps itself at the quadrature points, as in the papers: locks when the beam is slender
};

}  // namespace nurbeam
