#pragma once
#include <Eigen/Core>
#include <optional>

namespace nurbeam {

/// A place on a beam; lengths in reference arc length from the beam's start.
struct Place {
  enum class Kind { start, end, length, fraction, near } kind = Kind::start;
  double value = 0;                                 ///< [m] for length, [-] in [0,1] for fraction
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< [m] for near
  std::optional<double> within = {};  ///< greatest distance of the point from the axis [m] for near
};

}  // namespace nurbeam
