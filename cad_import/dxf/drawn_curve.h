#pragma once
#include <string>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// A curve in the unit of its drawing.
struct DrawnCurve {
  std::string entity;  ///< its kind
  NurbsCurve curve;
  std::string note = {};  ///< what was made of it that the drawing does not say; "" for nothing
  double deviation = 0;   ///< from what is drawn, where that is no NURBS curve
};

}  // namespace nurbeam
