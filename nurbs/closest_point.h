#pragma once
#include <Eigen/Core>
#include <functional>

#include "nurbs/bezier_path.h"

namespace nurbeam {

/// The closest place of a path to a point.
struct ClosestPoint {
  int segment;            ///< 0-based
  double u;               ///< parameter in that segment, [0,1]
  Eigen::Vector3d point;  ///< [m]
  double distance;        ///< [m]
};

/// Global closest point: candidates by bounding boxes of the control points (convex hull property) with
/// subdivision, digits by Newton. The path has at least one segment.
ClosestPoint closest_point(const BezierPath& path, const Eigen::Vector3d& point);

/// Largest distance from the points curve(u), u in [0,1], to a path [m]: sampled at 33 places and refined at
/// the maxima.
double largest_distance(const std::function<Eigen::Vector3d(double)>& curve, const BezierPath& path);

/// Largest distance between two paths, both ways (Hausdorff) [m]: sampled densely and refined at the maxima.
double hausdorff_distance(const BezierPath& a, const BezierPath& b);

}  // namespace nurbeam
