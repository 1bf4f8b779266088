#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// The longest step with which the classical Runge-Kutta method follows small vibrations about a state,
/// dampers included, without growth [s]; infinity where nothing swings, or no vibration is found.
double longest_explicit_step(const BeamSystem& system, const State& state);

/// A first step for error control [s], which no unit of time is hidden in: a part in 2000 of the time in
/// which a wave of tension runs along the quickest beam, at most a hundredth of the run. Among rigid guides
/// alone a hundred-thousandth of the run.
double first_step(const BeamModel& model, double end_time);

}  // namespace nurbeam
