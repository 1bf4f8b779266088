#pragma once
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The lines of a polyline, a curve of degree 1, with arcs of this radius in the place of its corners. Throws
/// std::runtime_error where there is no room for one.
std::vector<NurbsCurve> with_fillets(const NurbsCurve& polyline, double radius);

}  // namespace nurbeam
