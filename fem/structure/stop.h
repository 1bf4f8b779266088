#pragma once
#include <optional>
#include <string>

namespace nurbeam {

/// A buffer gives way when a body meets it: F = max(0, k x + c dx/dt), x its compression [m].
struct Buffer {
  double stiffness;    ///< k [N/m]
  double damping = 0;  ///< c [N s/m]
};

/// A stop keeps the body of a rider on one side of a place of its beam, or keeps two bodies on one beam
/// apart. Places go on over the seam of a ring.
struct Stop {
  int rider;                          ///< rider of the first body
  int other = -1;                     ///< rider of the second body, at greater s; -1: none
  double place = 0;                   ///< s of the stop, or the least distance of the two along the beam [m]
  bool from_below = true;             ///< with one body: its s is less than that of the stop; false: greater
  double restitution = 0;             ///< speed after over speed before an impact
  std::optional<Buffer> buffer = {};  ///< without a buffer the stop is hard

  /// Distance d, positive without contact: weight_of_rider s_joint + weight_of_other s_other + offset().
  double weight_of_rider() const { return other < 0 && !from_below ? 1 : -1; }
  double weight_of_other() const { return other < 0 ? 0 : 1; }
  double offset() const { return other < 0 && from_below ? place : -place; }
};

}  // namespace nurbeam
