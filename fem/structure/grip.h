#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// A grip takes hold of a body, a place of a beam, or a point in space.
struct Grip {
  int body = -1;
  int beam = -1;
  double s = 0;                                     ///< reference arc length of the place [m]
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of a grip at a point in space [m]

  static Grip on_body(int body) { return {.body = body}; }
  static Grip on_beam(int beam, double s) { return {.beam = beam, .s = s}; }
  static Grip at_point(const Eigen::Vector3d& point) { return {.point = point}; }
  bool is_point() const { return body < 0 && beam < 0; }
};

}  // namespace nurbeam
