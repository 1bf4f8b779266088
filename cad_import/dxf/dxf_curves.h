#pragma once
#include <string>
#include <vector>

#include "cad_import/dxf/dxf_entities.h"
#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// A curve in the unit of its drawing.
struct DrawnCurve {
  std::string entity;  ///< its kind
  NurbsCurve curve;
};

/// The curves of the entity, one of `all`, where its vertices stand behind it; none of one that is no curve.
/// Throws std::runtime_error or std::invalid_argument for one that is damaged or not read.
std::vector<DrawnCurve> curves_of(const DxfEntity& entity, const std::vector<DxfEntity>& all);

}  // namespace nurbeam
