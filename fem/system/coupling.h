#pragma once
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// The coupling of the unknowns of a matrix, by groups. All unknowns of a group are coupled with each other,
/// and every unknown with itself.
class Coupling {
 public:
  explicit Coupling(int unknowns) : size_(unknowns), group_starts_{0} {}

  /// Adds unknowns to the open group; negative ones are skipped.
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

  /// The pattern with an entry for each coupled pair.
  SparsePattern pattern() const;

 private:
  int size_;
  std::vector<int> members_, group_starts_;
};

}  // namespace nurbeam
