#pragma once
#include "fem/motion/run/run.h"

namespace nurbeam {

/// Applies the changes of the mesh that are due, each with an event and a restart of the integrator. A change
/// that would change the energy by too much waits as long as the motion can go on without it (can_wait).
/// Where it cannot wait, a body with a continuous slope gives up its node for good and is carried as a point
/// (SimulationReport::points_for_good). Where that would change the energy too, or the mesh is too coarse for
/// it (a hundredth of the energy), the run ends, as another motion would follow.
void settle_mesh(Run& run);

/// Replaces the charts of sections that have turned far; returns whether the run goes on.
[[nodiscard]] bool recentre_sections(Run& run);

}  // namespace nurbeam
