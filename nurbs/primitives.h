#pragma once
#include <vector>

#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// The straight line from a to b [m].
RationalCubic line_cubic(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// A circular arc from `start` to `end` about `center`, turning by the right hand about `normal` (of any
/// length), in pieces of at most 90 degrees (Eq. 43 of Ding & Ouyang); a whole turn where start and end are
/// one. Precondition: both are as far from the centre, across the normal.
std::vector<RationalCubic> arc_cubics(const Eigen::Vector3d& center, const Eigen::Vector3d& start,
                                      const Eigen::Vector3d& end, const Eigen::Vector3d& normal);

/// Circular arcs in the x-y plane from angle `start` to `end` [rad] in equal pieces (Eq. 43 of Ding &
/// Ouyang).
std::vector<RationalCubic> arc_cubics(const Eigen::Vector3d& center, double radius, double start, double end,
                                      int pieces);

}  // namespace nurbeam
