#pragma once
#include <span>
#include <vector>

#include "nurbs/rational_cubic.h"

namespace nurbeam {

struct SmoothCorners {
  std::vector<RationalCubic> segments;
  double deviation = 0;  ///< largest distance from the given cubics, measured above round-off [m]
};

/// The cubics, which meet end to end, with every corner of at most `angle` [rad] smoothed: both end tangents
/// are turned into the direction midway between them, about the shared point, which stays, as do the lengths
/// of the control polygon's legs. The last cubic is not smoothed towards the first.
SmoothCorners smooth_corners(std::span<const RationalCubic> segments, double angle);

}  // namespace nurbeam
