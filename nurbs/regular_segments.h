#pragma once
#include <span>
#include <vector>

#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// Cubics that meet end to end, none of them degenerate.
struct RegularSegments {
  std::vector<RationalCubic> segments;
  int dropped = 0;   ///< slivers left out
  int replaced = 0;  ///< cubics that had no speed at an end
  /// Largest distance from what was given, measured; of slivers one after another their length together [m].
  double deviation = 0;
};

/// Length of the control polygon, which is no less than that of the cubic [m].
double polygon_length(const RationalCubic& cubic);

/// The cubics without those of at most `sliver` [m], whose neighbours then meet where they ended, and with
/// others in place of those whose speed is zero at an end, within `tolerance` [m]: airfoils and hulls are
/// drawn so. The others stay as they are. Nothing is left of cubics that are all slivers.
RegularSegments regular_segments(std::span<const RationalCubic> segments, double sliver, double tolerance);

}  // namespace nurbeam
