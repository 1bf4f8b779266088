#pragma once
#include "cad_import/dxf/drawn_curve.h"
#include "cad_import/dxf/dxf_entities.h"

namespace nurbeam {

/// Whether a HELIX has the spline that programs write into it.
bool has_spline(const DxfEntity& helix);

/// A HELIX by its axis, start, radius at its end, turns and height of a turn, as cubics that touch it where
/// they meet. A radius other than that of its start makes it a cone. Throws std::runtime_error for one that
/// lacks a number or has no length.
DrawnCurve helix_curve(const DxfEntity& entity);

}  // namespace nurbeam
