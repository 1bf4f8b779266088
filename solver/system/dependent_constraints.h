#pragma once
#include <vector>

#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Dependent constraints: each fixes a rate that the others fix already, so that their multipliers cannot be
/// found.
struct DependentConstraints {
  std::vector<int> rows;         ///< numbers of their multipliers
  std::vector<int> coordinates;  ///< coordinates whose rates they fix
};

/// The dependent constraints of a system in a state: sets of rows of G, linked by coordinates, that add up to
/// zero with some factors to within 1e-9 of the largest.
std::vector<DependentConstraints> dependent_constraints(const SecondOrderSystem& system, const State& state);

}  // namespace nurbeam
