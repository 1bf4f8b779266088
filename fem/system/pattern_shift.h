#pragma once
#include <optional>
#include <span>
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// Which unknowns of a system are coupled, each with each in a group: those of its elements, in order along
/// the beams, and those of forces and constraints.
struct CoupledGroups {
  int unknowns = 0;
  std::vector<std::span<const int>> elements;  ///< coordinates, -1 where there is none
  std::vector<std::vector<int>> others;
};

/// How a system's unknowns and their coupling differ from those of another one of the same model: in one
/// stretch of unknowns, and by a number for all that come behind.
class PatternShift {
 public:
  /// Nothing where that is not all.
  static std::optional<PatternShift> between(const CoupledGroups& old, const CoupledGroups& now);

  /// That of `now`, from that of `old`.
  SparsePattern pattern(const SparsePattern& old, const CoupledGroups& now) const;
  /// How many of the first and of the last elements have columns that are as they were, but for what all are
  /// shifted by.
  int left() const { return left_; }
  int right() const { return right_; }
  /// How far the entries of the last ones have moved among all of `now`.
  int entries_by(const SparsePattern& old, const SparsePattern& now) const {
    return now.column_starts()[end_] - old.column_starts()[end_ - by_];
  }

 private:
  PatternShift() = default;
  // Of the unknowns of an element.
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

  int by_ = 0;                               // what comes behind has other numbers
  int same_left_ = 0, same_right_ = 0;       // elements that may be the same
  int changed_begin_ = 0, changed_end_ = 0;  // unknowns of the others, in numbers of now
  int begin_ = 0, end_ = 0;                  // the columns of these and of what is coupled with them
  int left_ = 0, right_ = 0;
  std::vector<Extent> extents_;  // of the elements of now
};

}  // namespace nurbeam
