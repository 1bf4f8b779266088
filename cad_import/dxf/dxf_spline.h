#pragma once
#include <vector>

#include "cad_import/dxf/drawn_curve.h"
#include "cad_import/dxf/dxf_entities.h"

namespace nurbeam {

/// The curves of a SPLINE, or of the spline in a HELIX: one, or its pieces where they do not meet. Of one of
/// fit points only: the cubic through them, its parameters chord lengths, with the end tangents that it has,
/// else straight at its ends; closed where it is. Throws std::runtime_error or std::invalid_argument for one
/// that is damaged.
std::vector<DrawnCurve> spline_curves(const DxfEntity& entity);

}  // namespace nurbeam
