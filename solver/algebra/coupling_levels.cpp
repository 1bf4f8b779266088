#include "solver/algebra/coupling_levels.h"

#include <algorithm>

namespace nurbeam {

CouplingLevels::CouplingLevels(const SparsePattern& pattern, int coordinates, const std::vector<int>& first,
                               int most)
    : unknowns(first), starts{0} {
  const int *columns = pattern.column_starts().data(), *rows = pattern.rows().data();
  std::vector<int> level_of(static_cast<std::size_t>(pattern.size()), -1);
  for (const int unknown : first) level_of[unknown] = 0;
  const auto each_coupled = [&](int unknown, const auto& visit) {
    for (int k = columns[unknown]; k < columns[unknown + 1]; ++k) visit(rows[k]);
  };
  // Whether a constraint has all its coordinates in the level before, where its own place is too.
  const auto comes_too_late = [&](int unknown) {
    if (unknown < coordinates) return false;
    bool alone = true;
    each_coupled(unknown, [&](int row) {
      alone = alone && (row >= coordinates || level_of[row] != level_of[unknown]);
    });
    return alone;
  };
  for (int level = 0, begin = 0; begin < static_cast<int>(unknowns.size()) && level < most; ++level) {
    const int end = static_cast<int>(unknowns.size());
    for (int k = begin; k < end; ++k) {
      if (k > begin && coupled_alike(pattern, unknowns[k - 1], unknowns[k])) continue;
      each_coupled(unknowns[k], [&](int row) {
        if (level_of[row] >= 0) return;
        level_of[row] = level + 1;
        unknowns.push_back(row);
      });
    }
    const auto next = std::partition(unknowns.begin() + end, unknowns.end(), comes_too_late);
    std::for_each(unknowns.begin() + end, next, [&](int unknown) { level_of[unknown] = level; });
    std::sort(unknowns.begin() + begin, next);
    begin = static_cast<int>(next - unknowns.begin());
    starts.push_back(begin);
  }
  unknowns.resize(static_cast<std::size_t>(starts.back()));
}

bool coupled_alike(const SparsePattern& pattern, int one, int other) {
  const int *starts = pattern.column_starts().data(), *rows = pattern.rows().data();
  return std::equal(rows + starts[one], rows + starts[one + 1], rows + starts[other],
                    rows + starts[other + 1]);
}

}  // namespace nurbeam
