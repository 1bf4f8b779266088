#pragma once
#include "fem/motion/events/step_events.h"
#include "fem/motion/run/run.h"

/// The settling of a damper just after a body meets it. A body of mass m that comes to a buffer, or tautens a
/// connector, loses its speed against the damper within about m/c. Steps with c h/m beyond 2 would ring,
/// average a force that does not exist, and lose count of the energy. The first steps are therefore short
/// against m/c, and grow as the transient dies out.
namespace nurbeam {

/// Shortens the next steps after an event at a damper, if the present step would be too long for it. False
/// where the mass matrix is singular.
[[nodiscard]] bool settle_damper(Run& run, const StepEvent& event);
/// Lengthens the limit of a transient after a step.
void grow_transient(Run& run);

}  // namespace nurbeam
