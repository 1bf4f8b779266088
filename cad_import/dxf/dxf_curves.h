#pragma once
#include <string_view>
#include <vector>

#include "cad_import/dxf/drawn_curve.h"
#include "cad_import/dxf/dxf_entities.h"

namespace nurbeam {

/// Whether entities of this kind are curves that are read.
bool is_curve_kind(std::string_view type);

/// The curves of the entity, one of `all`, where its vertices stand behind it; none of one of another kind.
/// Throws std::runtime_error or std::invalid_argument for one that is damaged.
std::vector<DrawnCurve> curves_of(const DxfEntity& entity, const std::vector<DxfEntity>& all);

}  // namespace nurbeam
