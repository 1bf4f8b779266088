#pragma once
#include "fem/motion/run/run.h"

namespace nurbeam {

/// Takes one accepted step, on the way to a time after `rest`, lands it at the first event in it, and passes
/// what follows from it; `nothing_leaves` a hard stop in it.
[[nodiscard]] bool take_step(Run& run, double step, double rest, bool nothing_leaves = false);

}  // namespace nurbeam
