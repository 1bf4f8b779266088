#pragma once
#include "fem/motion/run/run.h"

namespace nurbeam {

/// Takes one accepted step, on the way to a time after `rest`, lands it at its first event, and applies the
/// consequences. `nothing_leaves`: no body leaves a hard stop in it.
[[nodiscard]] bool take_step(Run& run, double step, double rest, bool nothing_leaves = false);

}  // namespace nurbeam
