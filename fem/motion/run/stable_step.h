#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// The longest step with which the classical Runge-Kutta method follows small vibrations about a state,
/// dampers included, without growth [s]; infinity where nothing swings, or no vibration is found.
double longest_explicit_step(const BeamSystem& system, const State& state);

}  // namespace nurbeam
