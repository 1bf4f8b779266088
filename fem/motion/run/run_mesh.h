#pragma once
#include "fem/motion/run/run.h"

namespace nurbeam {

/// Applies the changes of the mesh that are due, each with an event and a new start of the integrator. One
/// that would change the energy by too much waits as long as the motion can go on without it (can_wait), and
/// ends the run where it cannot: what came after it would be another motion.
void settle_mesh(Run& run);

/// Exchanges the charts of sections that have turned far; whether the run goes on.
[[nodiscard]] bool recentre_sections(Run& run);

}  // namespace nurbeam
