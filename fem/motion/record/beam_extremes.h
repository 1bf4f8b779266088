#pragma once
#include <cmath>

#include "fem/motion/record/snapshot.h"

/// The search for extremes along a beam.
namespace nurbeam {

/// An extreme among the values that elements have at their samples: the value of the largest size.
struct ElementExtreme {
  Extreme BeamRecord::*extreme;
  Eigen::Vector4d ElementRecord::*values;
  double (*size)(double);
  bool of_torsion = false;  ///< whether beams with torsion alone have it

  static double itself(double x) { return x; }
  static double negative(double x) { return -x; }
  static double magnitude(double x) { return std::abs(x); }
};
inline constexpr ElementExtreme element_extremes[] = {
    {&BeamRecord::axial_force_min, &ElementRecord::axial_force, ElementExtreme::negative},
    {&BeamRecord::axial_force_max, &ElementRecord::axial_force, ElementExtreme::itself},
    {&BeamRecord::moment_max, &ElementRecord::bending_moment, ElementExtreme::magnitude},
    {&BeamRecord::shear_force_max, &ElementRecord::shear_force, ElementExtreme::magnitude},
    {&BeamRecord::stress_max, &ElementRecord::stress, ElementExtreme::magnitude},
    {&BeamRecord::von_mises_max, &ElementRecord::von_mises, ElementExtreme::magnitude},
    {&BeamRecord::torque_max, &ElementRecord::torque, ElementExtreme::magnitude, true},
    {&BeamRecord::twist_max, &ElementRecord::twist, ElementExtreme::magnitude, true}};

/// Takes a value over if it is larger by `size`, or the first.
inline void keep(Extreme& extreme, double value, double s, double (*size)(double)) {
  if (std::isnan(value)) return;
  if (std::isnan(extreme.value) || size(value) > size(extreme.value)) extreme = {value, s};
}

/// Distance of a node from where it is drawn [m].
inline double displacement(const ReferenceCurve& curve, const Eigen::Vector3d& position, double s) {
  return (position - curve.position(s)).norm();
}

/// The reference arc length of a node [m].
inline double place_of(const ReferenceCurve& curve, const MeshNode& node, const State& state) {
  return node.place >= 0 ? curve.wrapped(state.q[node.place]) : node.s;
}

}  // namespace nurbeam
