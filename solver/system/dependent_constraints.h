#pragma once
#include <vector>

#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Constraints of which each fixes a rate that the others of them fix already, so that no multipliers can be
/// found for them.
struct DependentConstraints {
  std::vector<int> rows;         ///< of the multipliers
  std::vector<int> coordinates;  ///< whose rates they fix
};

/// Those of a system in a state: sets of rows of G, linked by coordinates, that add up to nothing with some
/// factors to within 1e-9 of the largest.
std::vector<DependentConstraints> dependent_constraints(const SecondOrderSystem& system, const State& state);

}  // namespace nurbeam
