#pragma once
#include "solver/second_order_system.h"

namespace nurbeam {

/// Brings a state that is close to an equilibrium, R(q, lambda) = 0 at rest, to it by Newton's iteration, in
/// place, as far as round-off lets it. Returns whether it was close enough: corrections shrink, and end far
/// below the system's coordinate_scale(). v and a stay what they are.
[[nodiscard]] bool settle_near(const SecondOrderSystem& system, State& state);

}  // namespace nurbeam
