#pragma once
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// A place where ends of curves lie.
struct CurveVertex {
  Eigen::Vector3d point;  ///< of its first end [m]
  std::vector<int> ends;  ///< 2 i: the start of curve i; 2 i + 1: its end; ascending
};

/// The start and the end point of every curve, [m].
std::vector<Eigen::Vector3d> end_points(const std::vector<NurbsCurve>& curves);

/// The ends of the curves, grouped: two ends at most `tolerance` [m] apart are in one vertex, and so are
/// those that a row of such ends connects. In order of first appearance. The time grows with the number of
/// curves, not with its square, as long as few different points are that near to each other.
std::vector<CurveVertex> vertices_of(const std::vector<NurbsCurve>& curves, double tolerance);

}  // namespace nurbeam
