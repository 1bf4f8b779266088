#pragma once
#include <optional>
#include <string>

namespace nurbeam {

/// What gives way where a body meets it: F = max(0, k x + c dx/dt) for how far x it is pressed in.
struct Buffer {
  double stiffness;    ///< k [N/m]
  double damping = 0;  ///< c [N s/m]
};

/// Keeps the body of a rider on one side of a place of its beam, or two bodies on one beam apart.
/// Places go on over the seam of a ring.
struct Stop {
  int rider;                          ///< of the body
  int other = -1;                     ///< rider of the second body, at greater s; -1: none
  double place = 0;                   ///< s of the stop, or the least distance of the two along the beam [m]
  bool from_below = true;             ///< of one body: its s is less than that of the stop; else greater
  double restitution = 0;             ///< of the speeds after and before an impact
  std::optional<Buffer> buffer = {};  ///< else it is hard

  /// d, which is positive where they do not touch: weight_of_rider s_joint + weight_of_other s_other +
  /// offset().
  double weight_of_rider() const { return other < 0 && !from_below ? 1 : -1; }
  double weight_of_other() const { return other < 0 ? 0 : 1; }
  double offset() const { return other < 0 && from_below ? place : -place; }
};

}  // namespace nurbeam
