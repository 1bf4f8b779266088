#pragma once
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// An order of the unknowns of a square pattern, which should be symmetric: else the order is poor, not
/// wrong. As they are numbered where that is narrow (close_order), else the reverse order of Cuthill and
/// McKee.
struct BandOrder {
  /// Of all unknowns but those `left_out`. What is coupled with these comes last in its component where that
  /// makes no wider band.
  explicit BandOrder(const SparseView& pattern, const std::vector<int>& left_out = {});
  /// Of these unknowns alone, in the order in which they come.
  static BandOrder of(const SparseView& pattern, std::vector<int> unknowns);
  /// The same with places left free before unknowns that reach equally far, as those of a node, where they
  /// are a multiple of `block`: they then begin at such a multiple too.
  BandOrder aligned(int block) const;

  std::vector<int> unknown;  ///< at each place of the order, -1 where that is free
  std::vector<int> place;    ///< of each unknown, -1 where it is left out
  std::vector<int> ends;     ///< one past the last column of each row, by places
  std::vector<int> below;    ///< last row that has an entry in a column, or in one before it
  int half_bandwidth = 0;    ///< greatest distance of an entry from the diagonal

 private:
  BandOrder() = default;
  void place_unknowns(const SparseView& pattern);
};

}  // namespace nurbeam
