#pragma once
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// Whether a cubic is the line between its ends, but for round-off of a drawing.
inline bool is_straight(const RationalCubic& cubic) {
  constexpr double round_off = 1e-9;  // of its length
  const Eigen::Vector3d a = cubic.control_point(0), chord = cubic.control_point(3) - a;
  for (int i = 1; i < 3; ++i) {
    const Eigen::Vector3d off = cubic.control_point(i) - a;
    if ((off - off.dot(chord) / chord.squaredNorm() * chord).norm() > round_off * chord.norm()) return false;
  }
  return true;
}

}  // namespace nurbeam
