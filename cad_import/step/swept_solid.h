#pragma once
#include <TopoDS_Shape.hxx>
#include <string>
#include <utility>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// swept_pipe() or swept_profile(). Far from the origin with tolerances above the digits of its coordinates.
TopoDS_Shape swept_solid(const NamedSolid& solid);

/// The same for STEP, which holds no tolerances: without a location, its curves and surfaces lying where they
/// belong. Readers raise tolerances by what they find these to be apart, but not by the digits of a location.
TopoDS_Shape swept_solid_in_place(const NamedSolid& solid);

/// Name of the solid and of its part.
std::pair<std::string, std::string> names_of(const NamedSolid& solid);

}  // namespace nurbeam
