#pragma once
#include "fem/motion/run.h"

namespace nurbeam {

/// Applies the changes of the mesh that are due, each with an event, exchanges the charts of sections that
/// have turned far, and starts the integrator anew behind them; whether the run goes on. A change that would
/// change the energy by too much waits as long as the motion can go on without it (can_wait), and ends the
/// run where it cannot: what came after it would be another motion.
[[nodiscard]] bool settle_mesh(Run& run);

}  // namespace nurbeam
