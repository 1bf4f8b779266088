#pragma once
#include <Eigen/Geometry>
#include <gp_GTrsf.hxx>
#include <gp_Trsf.hxx>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The transformation of points in metres that this one is of points in `unit` [m].
Eigen::Affine3d in_metres(const gp_GTrsf& transformation, double unit);

/// The curve under the transformation: exact, since it acts on the control points.
NurbsCurve placed(const NurbsCurve& curve, const Eigen::Affine3d& transformation);

}  // namespace nurbeam
