#pragma once
#include <optional>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// The part of the velocities near new elements that can grow or shrink while the total momentum stays and
/// constraints hold: the nearest one in the mass norm. It has rates of positions and slopes of the nodes of
/// these elements, and of bodies on them.
struct RelativeMotion {
  std::vector<int> coordinates;
  Eigen::VectorXd velocities;  ///< (k) rates of `coordinates`
  double kinetic = 0;          ///< energy that the motion has by these velocities [J]
  double of_bodies = 0;        ///< the largest share of them in the sliding speed of a body

  /// The factor g for which adding g times these velocities takes an energy e [J] away: sqrt(1 - e / kinetic)
  /// - 1. Nothing where a body would slide faster or slower by more than 5e-4 of its speed, or the beam would
  /// move much differently.
  std::optional<double> growth(double e) const;
};

/// The relative motion of `state`, a state of `to`; `from` is the mesh before. Elements with the pointwise
/// strain are left out: a merge changes their shape, not their motion. The equations are [M C'; C 0][d; y] =
/// [(M v); 0] in the rows of these coordinates, with constraints and momenta C.
RelativeMotion relative_motion(const BeamSystem& from, const BeamSystem& to, const State& state);

}  // namespace nurbeam
