#pragma once
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// Which unknowns of a matrix are coupled: groups, of which each is coupled with each, and all with
/// themselves.
class Coupling {
 public:
  explicit Coupling(int unknowns) : size_(unknowns), group_starts_{0} {}

  /// Adds to the group that is open; those below 0 are none.
  template <class Unknowns>
  void add(const Unknowns& unknowns) {
    for (const int i : unknowns)
      if (i >= 0) members_.push_back(i);
  }
  void add(int first, int count) {
    for (int i = first; i < first + count; ++i) members_.push_back(i);
  }
  /// Ends the group.
  void close() { group_starts_.push_back(static_cast<int>(members_.size())); }

  /// With an entry where two are coupled.
  SparsePattern pattern() const;

 private:
  int size_;
  std::vector<int> members_, group_starts_;
};

}  // namespace nurbeam
