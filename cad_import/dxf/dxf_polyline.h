#pragma once
#include <vector>

#include "cad_import/dxf/drawn_curve.h"
#include "cad_import/dxf/dxf_entities.h"

namespace nurbeam {

/// An LWPOLYLINE: one curve of degree 1, or its lines and arcs. Throws std::runtime_error for one that is
/// damaged.
std::vector<DrawnCurve> light_polyline(const DxfEntity& entity);

/// Whether a POLYLINE is a mesh, which is no curve.
bool is_mesh(const DxfEntity& entity);

/// A POLYLINE, whose corners are the VERTEX entities after it in `all`: likewise; one that was fitted by a
/// spline (PEDIT) is that spline, of its frame. Throws std::runtime_error for one that is damaged.
std::vector<DrawnCurve> heavy_polyline(const DxfEntity& entity, const std::vector<DxfEntity>& all);

}  // namespace nurbeam
