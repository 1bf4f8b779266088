#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// Points joined by straight lines whose corners are arcs, as bent tubes are drawn.
struct BentLines {
  std::vector<Eigen::Vector3d> points;  ///< each apart from the one before [m]
  /// Of the arcs: one radius for all corners, or one for each in turn [m].
  std::vector<double> radii;

  /// Whether the last point is the first: the corner there is the last one.
  bool closed() const;
  /// Number of points at which lines meet, whether they turn there or not.
  std::size_t corner_count() const;
  /// The point of a corner, from 0.
  std::size_t point_of(std::size_t corner) const { return corner + 1 < points.size() - 1 ? corner + 1 : 0; }
};

/// A corner at which the arc is longer than the lines.
struct TightBend {
  std::size_t corner;
  double radius;   ///< asked for [m]
  double largest;  ///< for which there is room there; of one radius for all, the largest of that [m]
  bool folds;      ///< the line goes back on itself, which no arc can round
};

/// The tightest of the corners that have no room for their arcs; nothing where all have. Precondition: as
/// many radii as corners, or one.
std::optional<TightBend> tight_bend(const BentLines& lines);

/// The lines between the arcs and the arcs, which are exact and begin and end where they touch the lines. Of
/// closed ones the curve starts at the end of the arc at the first point. Precondition: no tight bend.
std::vector<RationalCubic> bent_line_cubics(const BentLines& lines);

}  // namespace nurbeam
