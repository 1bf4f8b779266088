#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// The drawn state; velocities, accelerations and multipliers are zero.
State drawn_state(const BeamSystem& system);
/// Sets velocities: the material is at rest or moves by Beam::velocity; each rider's body moves along the
/// beam with its initial speed; bodies without a rider have their own.
void start_moving(const BeamSystem& system, State& state);

/// Moves bodies that stand apart to where their nodes, or the sections that they follow, carry them, and
/// gives them the velocities there.
void carry_bodies(const BeamSystem& system, State& state);

}  // namespace nurbeam
