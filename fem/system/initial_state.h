#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// The drawn shape; velocities, accelerations and multipliers zero.
State drawn_state(const BeamSystem& system);
/// Sets velocities: the material at rest or as Beam::velocity has it, each rider's body moving along the beam
/// with its initial speed, bodies without a rider with theirs.
void start_moving(const BeamSystem& system, State& state);

/// Puts bodies that stand apart from their nodes where these or the sections that they follow carry them, and
/// gives them their velocity.
void carry_bodies(const BeamSystem& system, State& state);

}  // namespace nurbeam
