#pragma once
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The curve in pieces, cut at these parameters in any order; those that are not strictly inside it cut
/// nothing. Each piece keeps the parameters of the curve.
std::vector<NurbsCurve> split_at(const NurbsCurve& curve, std::vector<double> parameters);

}  // namespace nurbeam
