#pragma once
#include <vector>

#include "solver/algebra/equilibrated_kkt.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// A system, and a state that is close to an equilibrium of it.
struct NearRest {
  const SecondOrderSystem* system;
  State* state;
};

/// Brings states to the equilibria they are close to, R(q, lambda) = 0 at rest, in place, as far as round-off
/// lets them: with factors of one tangent that is near those of all, as neighbours of one rest have, and by
/// Newton's iteration where corrections with it do not shrink fast. Returns whether all were close enough:
/// corrections shrink, and end far below the system's coordinate_scale(). v and a stay what they are.
/// Precondition: systems of one size; near.regular().
[[nodiscard]] bool settle_near(const std::vector<NearRest>& rests, const EquilibratedKkt& near);

}  // namespace nurbeam
