#pragma once
#include <Eigen/Core>
#include <functional>
#include <span>

#include "nurbs/box_tree.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// The closest place of a row of cubics to a point.
struct ClosestPoint {
  int segment;            ///< 0-based
  double u;               ///< parameter in that segment, [0,1]
  Eigen::Vector3d point;  ///< [m]
  double distance;        ///< [m]
};

/// The closest points of cubics to many points: candidates by a tree of the boxes of the control points
/// (convex hull property) and subdivision, digits by Newton.
class ClosestPoints {
 public:
  /// At least one cubic; they need not meet, and must outlive this.
  explicit ClosestPoints(std::span<const RationalCubic> segments);

  ClosestPoint to(const Eigen::Vector3d& point) const;
  /// Largest distance from the points curve(u), u in [0,1], to the cubics [m]: sampled at 33 places and
  /// refined at the maxima.
  double largest_distance(const std::function<Eigen::Vector3d(double)>& curve) const;

 private:
  std::span<const RationalCubic> segments_;
  BoxTree boxes_;
  double round_off_;  // of distances [m]
};

/// That to one point.
ClosestPoint closest_point(std::span<const RationalCubic> segments, const Eigen::Vector3d& point);

/// Largest distance from the points curve(u), u in [0,1], to cubics [m], as ClosestPoints has it.
double largest_distance(const std::function<Eigen::Vector3d(double)>& curve,
                        std::span<const RationalCubic> segments);

/// Largest distance between two rows of cubics, both ways (Hausdorff) [m]: sampled densely and refined at the
/// maxima.
double hausdorff_distance(std::span<const RationalCubic> a, std::span<const RationalCubic> b);

}  // namespace nurbeam
