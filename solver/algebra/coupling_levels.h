#pragma once
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// Unknowns in levels, by over how many others they are coupled with the first ones: what is in a level is
/// coupled with that, with the one before and with the one after alone. A multiplier is in the last level of
/// the coordinates that its constraint holds.
struct CouplingLevels {
  std::vector<int> unknowns;  ///< one level after the other, each in order
  std::vector<int> starts;    ///< of the levels among them, and the end

  /// `pattern`: symmetric, of so many coordinates and then multipliers; `most`: levels.
  CouplingLevels(const SparsePattern& pattern, int coordinates, const std::vector<int>& first, int most);
  int count() const { return static_cast<int>(starts.size()) - 1; }
};

/// Whether two unknowns are coupled with the same ones.
bool coupled_alike(const SparsePattern& pattern, int one, int other);

}  // namespace nurbeam
