#pragma once
#include <Eigen/Core>
#include <vector>

#include "nurbs/bezier_path.h"
#include "nurbs/closest_point.h"
#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// The distances of points from NURBS curves of any degree.
class CurveDistance {
 public:
  /// At least one curve; they must outlive this. The closest place of a curve of degree above 3 is looked for
  /// on cubics within `closeness` [m] > 0 of it, and then on the curve itself: of places whose distances
  /// differ by less than that either may be taken.
  CurveDistance(const std::vector<NurbsCurve>& curves, double closeness);
  CurveDistance(const CurveDistance&) = delete;
  CurveDistance& operator=(const CurveDistance&) = delete;

  /// From the point to the closest of all curves [m].
  double to(const Eigen::Vector3d& point) const;
  /// Largest distance from the points of a curve to the curves [m], sampled and refined at the maxima.
  double largest_from(const NurbsCurve& curve) const;

 private:
  /// The part of a curve that a cubic stands for; no curve where it is that part itself.
  struct Source {
    const NurbsCurve* curve;
    double start, end;
  };

  CurveDistance(const std::vector<NurbsCurve>& curves, const std::vector<BezierPath>& paths,
                double closeness);

  double closeness_;
  std::vector<RationalCubic> cubics_;
  std::vector<Source> sources_;  // of the cubics
  ClosestPoints closest_;
  double round_off_;  // of distances [m]
};

}  // namespace nurbeam
