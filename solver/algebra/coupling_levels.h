#pragma once
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// Unknowns in levels, by the number of couplings from the first ones. Unknowns of a level are coupled only
/// within the level, with the one before and with the one after. A multiplier is in the last level of the
/// coordinates that its constraint holds.
struct CouplingLevels {
  std::vector<int> unknowns;  ///< one level after the other, each in order
  std::vector<int> starts;    ///< start of each level among them, and the end

  /// `pattern`: symmetric, with `coordinates` coordinates and then multipliers; `most`: limit of the levels.
  CouplingLevels(const SparsePattern& pattern, int coordinates, const std::vector<int>& first, int most);
  int count() const { return static_cast<int>(starts.size()) - 1; }
};

/// Whether two unknowns are coupled with the same unknowns.
bool coupled_alike(const SparsePattern& pattern, int one, int other);

}  // namespace nurbeam
