#pragma once
#include "fem/motion/events/step_events.h"
#include "fem/motion/run/run.h"

/// What a damper does first to what meets it: a body of mass m that comes to a buffer, or tautens a
/// connector, loses its speed against it within about m/c. Steps of c h/m beyond 2 would ring, take a force
/// for mean that is none, and lose count of the energy: the first ones are short against m/c and grow as what
/// is to be followed dies out.
namespace nurbeam {

/// Shortens the next steps after an event at whose damper the step that is asked for would be long. False
/// where the mass matrix is singular.
[[nodiscard]] bool settle_damper(Run& run, const StepEvent& event);
/// After a step.
void grow_transient(Run& run);

}  // namespace nurbeam
