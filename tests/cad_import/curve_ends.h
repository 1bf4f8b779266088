#pragma once
#include <Eigen/Core>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

inline Eigen::Vector3d start_of(const NurbsCurve& curve) { return curve.point(curve.knots().start()); }
inline Eigen::Vector3d end_of(const NurbsCurve& curve) { return curve.point(curve.knots().end()); }

}  // namespace nurbeam
