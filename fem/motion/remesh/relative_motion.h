#pragma once
#include <optional>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// What of the velocities near new elements can grow or shrink while the total momentum stays and constraints
/// hold: the nearest such to them, in the mass norm, of positions and slopes of the nodes of these elements
/// and of bodies on them.
struct RelativeMotion {
  std::vector<int> coordinates;
  Eigen::VectorXd velocities;  ///< (k) of these
  double kinetic = 0;          ///< the energy that the motion has by them [J]
  double of_bodies = 0;        ///< the largest part that they are of how fast a body slides

  /// The part of these velocities that, added, takes an energy e [J] away: sqrt(1 - e / kinetic) - 1. Nothing
  /// where a body would slide faster or slower by more than 5e-4 of its speed, or the beam move much else.
  std::optional<double> growth(double e) const;
};

/// Of the motion `state` of `to`, of which `from` is the mesh before; of no elements with the pointwise
/// strain, whose shape, not whose motion, a merge changes. [M C'; C 0][d; y] = [(M v); 0] in the rows of
/// these coordinates, with constraints and momenta C.
RelativeMotion relative_motion(const BeamSystem& from, const BeamSystem& to, const State& state);

}  // namespace nurbeam
