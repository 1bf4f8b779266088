#pragma once
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The start or the end of one curve of a list.
struct CurveEnd {
  int curve;    ///< 0-based
  bool at_end;  ///< else at its start

  friend bool operator==(const CurveEnd&, const CurveEnd&) = default;
};

/// A place where ends of curves lie.
struct CurveVertex {
  Eigen::Vector3d point;       ///< of its first end [m]
  std::vector<CurveEnd> ends;  ///< in the order of the curves, a start before its end
};

/// The start and the end point of every curve, one after another [m].
std::vector<Eigen::Vector3d> end_points(const std::vector<NurbsCurve>& curves);

/// The ends of the curves, grouped: two ends at most `tolerance` [m] apart are in one vertex, and so are
/// those that a row of such ends connects. In order of first appearance. The time grows with the number of
/// curves, not with its square, as long as few different points are that near to each other.
std::vector<CurveVertex> vertices_of(const std::vector<NurbsCurve>& curves, double tolerance);

}  // namespace nurbeam
