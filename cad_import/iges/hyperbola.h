#pragma once
#include "nurbs/nurbs_curve.h"

class IGESGeom_ConicArc;

namespace nurbeam {

/// The arc of a hyperbola (entity 104) as a rational quadratic, from its equation and its ends, in the unit
/// of the file times `unit` and where the entity's transformation puts it. OpenCASCADE makes nothing of some.
/// Throws std::runtime_error when the ends are not on one branch of it.
NurbsCurve hyperbola_arc(const IGESGeom_ConicArc& entity, double unit);

}  // namespace nurbeam
