#pragma once
#include <Eigen/Core>
#include <StepGeom_BSplineCurve.hxx>
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The knots of a B-spline or Bezier curve of STEP, each as often as it stands; of one that has none those of
/// its arcs.
std::vector<double> knots_of(const StepGeom_BSplineCurve& curve);

/// Its control points, homogeneous. Throws std::runtime_error where they have not three coordinates, or the
/// weights are not as many.
Eigen::Matrix4Xd control_points_of(const StepGeom_BSplineCurve& curve);

/// The knots 0 and `spans` as often as degree + 1, those between as often as the degree.
std::vector<double> clamped_knots(int degree, int spans);

/// Gives a curve with knots those of another of its degree, and its control points.
void set_values(StepGeom_BSplineCurve& curve, const std::vector<double>& knots,
                const Eigen::Matrix4Xd& control_points);

}  // namespace nurbeam
