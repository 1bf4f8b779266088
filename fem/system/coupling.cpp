#include "fem/system/coupling.h"

#include <algorithm>
#include <utility>

namespace nurbeam {

SparsePattern Coupling::pattern() const {
  // The groups of each unknown, one unknown after the other.
  std::vector<int> first_group(static_cast<std::size_t>(size_) + 1, 0), groups(members_.size());
  for (const int i : members_) ++first_group[i + 1];
  for (int i = 0; i < size_; ++i) first_group[i + 1] += first_group[i];
  std::vector<int> next = first_group;
  for (int g = 0; g + 1 < static_cast<int>(group_starts_.size()); ++g)
    for (int k = group_starts_[g]; k < group_starts_[g + 1]; ++k) groups[next[members_[k]]++] = g;

  // Unknowns in the same groups, as those of one node are, have columns with the same rows.
  const auto is_like_previous = [&](int column) {
    if (column == 0) return false;
    const int begin = first_group[column], end = first_group[column + 1], before = first_group[column - 1];
    return begin < end && end - begin == begin - before &&
           std::equal(groups.begin() + begin, groups.begin() + end, groups.begin() + before);
  };
  std::vector<int> rows, starts(static_cast<std::size_t>(size_) + 1, 0),
      last_column(static_cast<std::size_t>(size_), -1);
  rows.reserve(2 * members_.size());
  for (int column = 0; column < size_; ++column) {
    const auto begin = static_cast<std::ptrdiff_t>(rows.size());
    if (is_like_previous(column)) {
      const auto previous = starts[column - 1];
      rows.resize(rows.size() + static_cast<std::size_t>(begin - previous));
      std::copy_n(rows.begin() + previous, begin - previous, rows.begin() + begin);
      starts[column + 1] = static_cast<int>(rows.size());
      continue;
    }
    const auto take = [&](int row) {
      if (last_column[row] == column) return;
      last_column[row] = column;
      rows.push_back(row);
    };
    take(column);
    for (int k = first_group[column]; k < first_group[column + 1]; ++k)
      std::for_each(members_.begin() + group_starts_[groups[k]],
                    members_.begin() + group_starts_[groups[k] + 1], take);
    std::sort(rows.begin() + begin, rows.end());
    starts[column + 1] = static_cast<int>(rows.size());
  }
  rows.shrink_to_fit();
  return {std::move(starts), std::move(rows)};
}

}  // namespace nurbeam
