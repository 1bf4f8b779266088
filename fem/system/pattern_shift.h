#pragma once
#include <optional>
#include <span>
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// Groups of coupled unknowns of a system: those of its elements, in order along the beams, and those of
/// forces and constraints.
struct CoupledGroups {
  int unknowns = 0;
  std::vector<std::span<const int>> elements;  ///< coordinates, -1 where there is none
  std::vector<std::vector<int>> others;
};

/// The difference in unknowns and their coupling between two systems of one model: in one stretch of
/// unknowns, and in the numbers of all unknowns behind it, which are shifted.
class PatternShift {
 public:
  /// The shift between two systems; nothing where they differ otherwise.
  static std::optional<PatternShift> between(const CoupledGroups& old, const CoupledGroups& now);

  /// The pattern of `now`, from the pattern of `old`.
  SparsePattern pattern(const SparsePattern& old, const CoupledGroups& now) const;
  /// Number of first elements, and of last elements, whose columns are unchanged but for the shift.
  int left() const { return left_; }
  int right() const { return right_; }
  /// Shift of the entries of the last elements among all entries of `now`.
  int entries_by(const SparsePattern& old, const SparsePattern& now) const {
    return now.column_starts()[end_] - old.column_starts()[end_ - by_];
  }

 private:
  PatternShift() = default;
  // The range of the unknowns of an element.
  struct Extent {
    int lowest, highest;
  };
  static Extent extent(std::span<const int> dofs);

  bool find_changed(const CoupledGroups& old, const CoupledGroups& now);
  void find_renewed(const CoupledGroups& now);
  bool holds_elements(const CoupledGroups& old, const CoupledGroups& now) const;
  bool holds_others(const CoupledGroups& old, const CoupledGroups& now) const;
  bool is_kept(int now, int old) const {
    return now < changed_begin_ ? old == now : now >= changed_end_ && old == now - by_;
  }
  bool is_changed(int now) const { return now >= changed_begin_ && now < changed_end_; }
  bool is_renewed(int now) const { return now >= begin_ && now < end_; }
  SparsePattern renewed_columns(const CoupledGroups& now) const;

  int by_ = 0;                               // shift of the numbers behind the stretch
  int same_left_ = 0, same_right_ = 0;       // numbers of elements that may be the same
  int changed_begin_ = 0, changed_end_ = 0;  // unknowns of the other elements, in the numbers of now
  int begin_ = 0, end_ = 0;                  // columns of the changed unknowns and of those coupled with them
  int left_ = 0, right_ = 0;
  std::vector<Extent> extents_;  // per element of now
};

}  // namespace nurbeam
