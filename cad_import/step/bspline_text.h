#pragma once
#include <string>

#include "cad_import/step/step_instances.h"
#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// A real in 17 digits, as ISO 10303-21 writes it.
std::string step_real(double value);

/// The number of a CARTESIAN_POINT that is added.
int add_point(const Eigen::Vector3d& point, StepInstances& step);

/// The value of a B-spline instance; its points are added. ISO 10303-42: b_spline_curve_with_knots, in a
/// complex instance with rational_b_spline_curve where the weights differ.
std::string bspline_value(const NurbsCurve& curve, const std::string& encoded_name, StepInstances& step);

}  // namespace nurbeam
