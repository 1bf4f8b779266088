#pragma once
#include <Standard_Transient.hxx>

namespace nurbeam {

/// What was done to a B-spline curve of STEP.
struct SplineRepair {
  double knots = 0;  ///< the largest change of a knot, as a part of their range
};

/// Says a B-spline curve of STEP anew where OpenCASCADE reads none of it: knots that decrease or differ at an
/// end in their last digits are made one, and pieces that a knot inside, degree + 1 times, divides, are one
/// curve where they meet. Others stay as they are.
SplineRepair make_sound(const opencascade::handle<Standard_Transient>& entity);

}  // namespace nurbeam
