#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// Cubics that meet end to end, the last one the first; in the plane z = 0.
using Loop = std::vector<RationalCubic>;

/// The part of a profile's boundary between two corners of a polygon: segment `segment` of a loop from u0 to
/// u1.
struct BoundaryPiece {
  int loop;
  int segment;
  double u0, u1;
};

/// a_x b_y - a_y b_x.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A closed polygon with its corners on a loop; piece i runs from corner i to the next.
struct ProfilePolygon {
  std::vector<Eigen::Vector2d> corners;  ///< [m]
  std::vector<BoundaryPiece> pieces;

  /// Positive when it runs anticlockwise [m^2].
  double area() const;
  /// By its winding number; either for a point on the polygon.
  bool contains(const Eigen::Vector2d& point) const;
};

/// The point of a piece on the perpendicular bisector of its chord: its parameter.
double middle_of(const Loop& loop, const BoundaryPiece& piece);

/// A polygon for each loop: the segments cut until no leg of a piece's control
/// polygon turns from its chord by more than `angle` [rad].
std::vector<ProfilePolygon> profile_polygons(const std::vector<Loop>& loops, double angle);

/// A point where two edges of the polygons cross or touch other than in a common corner.
std::optional<Eigen::Vector2d> crossing(const std::vector<ProfilePolygon>& polygons);

/// Polygons that do not cross: cut at 15 degrees, and finer where that is needed. Empty when they still cross
/// at a hundredth of that.
std::vector<ProfilePolygon> polygons_without_crossing(const std::vector<Loop>& loops);

}  // namespace nurbeam
