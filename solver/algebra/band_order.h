#pragma once
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// An order of the unknowns of a square pattern. For an unsymmetric pattern the order is poor, not wrong.
/// Where the numbers give a narrow band the unknowns keep them (close_order), else the order is the reverse
/// one of Cuthill and McKee.
struct BandOrder {
  /// Orders all unknowns but those `left_out`. Unknowns coupled with them come last in their component, where
  /// that makes the band no wider.
  explicit BandOrder(const SparseView& pattern, const std::vector<int>& left_out = {});
  /// An order of these unknowns alone, as they are given.
  static BandOrder of(const SparseView& pattern, std::vector<int> unknowns);
  /// This order, aligned to blocks. If groups of unknowns that reach equally far, as those of a node, have a
  /// multiple of `block` members, they begin at such a multiple too: places before them are left free.
  BandOrder aligned(int block) const;

  std::vector<int> unknown;  ///< unknown at each place of the order, -1 where the place is free
  std::vector<int> place;    ///< place of each unknown, -1 where it is left out
  std::vector<int> ends;     ///< one past the last column of each row, by places
  std::vector<int> below;    ///< last row that has an entry in a column, or in one before it
  int half_bandwidth = 0;    ///< greatest distance of an entry from the diagonal

 private:
  BandOrder() = default;
  void place_unknowns(const SparseView& pattern);
};

}  // namespace nurbeam
