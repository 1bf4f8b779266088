#pragma once
#include <vector>

#include "solver/algebra/equilibrated_kkt.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// A system, and a state close to one of its equilibria.
struct NearRest {
  const SecondOrderSystem* system;
  State* state;
};

/// Brings states, in place, to the equilibria that are close, R(q, lambda) = 0 at rest, as far as round-off
/// allows. `near`: factors of one tangent that is near those of all states, as for neighbours of one rest.
/// Where corrections with them do not shrink fast, Newton's iteration is used.
///
/// Returns whether all states were close enough: corrections shrink, and end far below the system's
/// coordinate_scale(). v and a stay unchanged. Precondition: systems of one size; near.regular().
[[nodiscard]] bool settle_near(const std::vector<NearRest>& rests, const EquilibratedKkt& near);

}  // namespace nurbeam
