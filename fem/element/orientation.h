#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

namespace nurbeam {

/// How the sections of a beam in space are drawn along its axis: where their axis d2 (a profile's y) points.
struct Orientation {
  enum class Rule {
    start,  ///< at s = 0 along `direction` (its part across the tangent), from there without twist
    up,     ///< everywhere along the part of `direction` across the tangent
    frenet  ///< towards the centre of curvature
  };
  Rule rule = Rule::start;
  /// Need not be across the tangent nor of unit length; zero with Rule::start: z, or x where the beam starts
  /// along z.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// (s [m], angle [rad]), s increasing: turned about the tangent besides, by a monotone C1 cubic through the
  /// rows, constant outside.
  std::vector<std::pair<double, double>> twist = {};
};

}  // namespace nurbeam
