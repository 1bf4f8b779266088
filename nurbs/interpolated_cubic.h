#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The C2 cubic spline through points (3 x n [m]) at increasing parameters, its end slopes those of the
/// cubics through the first and the last four points (of fewer, their polynomial): of fourth order in the
/// distance of the parameters. Its knots are the parameters, whatever the points are. Throws
/// std::invalid_argument unless there are at least two points, and as many parameters, increasing.
NurbsCurve interpolated_cubic(const std::vector<double>& parameters, const Eigen::Matrix3Xd& points);

/// Of a spline at its ends; where one is missing its second derivative is zero there.
struct EndSlopes {
  std::optional<Eigen::Vector3d> start, end;
};

/// The C2 cubic spline through points with these slopes at its ends; else as the other.
NurbsCurve interpolated_cubic(const std::vector<double>& parameters, const Eigen::Matrix3Xd& points,
                              const EndSlopes& ends);

/// The closed one, C2 also where its last point meets its first, which are the same. Throws
/// std::invalid_argument unless there are at least three different points and this one.
NurbsCurve closed_interpolated_cubic(const std::vector<double>& parameters, const Eigen::Matrix3Xd& points);

}  // namespace nurbeam
