#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

namespace nurbeam {

/// The orientation of the sections of a drawn beam in space: the rule for the direction of their axis d2 (a
/// profile's y).
struct Orientation {
  enum class Rule {
    start,  ///< at s = 0 along `direction` (its part across the tangent), further on without twist
    up,     ///< everywhere along the part of `direction` across the tangent
    frenet  ///< towards the centre of curvature
  };
  Rule rule = Rule::start;
  /// Direction for d2; need not be across the tangent nor of unit length. Zero with Rule::start means z, or x
  /// where the beam starts along z.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// Added turn about the tangent in rows (s [m], angle [rad]), s increasing: a monotone C1 cubic through the
  /// rows, constant outside.
  std::vector<std::pair<double, double>> twist = {};
};

}  // namespace nurbeam
