#pragma once
#include <span>
#include <vector>

#include "solver/algebra/coupling_levels.h"

namespace nurbeam {

/// A front: unknowns of one level that are eliminated together. The remainder goes to a front of the level
/// before, with all unknowns of that level that are coupled with them. Unknowns are given by places, one
/// front after the other.
struct Front {
  int first, own;            ///< unknowns of the front
  int first_before, before;  ///< unknowns of the front of the level before
  int parent;                ///< index of that front, -1: none
  /// Start of its blocks among all blocks, one after the other and each row by row: rows of its own, columns
  /// of its own (own, own); rows of its own, columns before (own, before); rows before, columns of its own
  /// (before, own).
  int blocks;

  int upper() const { return blocks + own * own; }
  int lower() const { return upper() + own * before; }
  int end() const { return lower() + before * own; }
};

/// The fronts of unknowns in levels, eliminated from outside in. Unknowns of a level are in one front if they
/// are coupled there, or by eliminated unknowns.
class Fronts {
 public:
  Fronts(const SparsePattern& pattern, const CouplingLevels& levels);

  /// The unknowns, level by level, front by front.
  const std::vector<int>& unknowns() const { return unknowns_; }
  /// First unknown of a level, and the end.
  int start(int level) const { return starts_[level]; }
  int level_count() const { return static_cast<int>(starts_.size()) - 1; }
  std::span<const Front> of_level(int level) const {
    return {fronts_.data() + first_front_[level], fronts_.data() + first_front_[level + 1]};
  }
  std::span<const Front> all() const { return fronts_; }
  /// Number of entries of all blocks.
  int block_size() const { return fronts_.back().end(); }
  /// Index in the blocks of the entry in a row and a column, by their places; -1: there is none.
  int index(int row, int column) const;

 private:
  std::vector<int> unknowns_, starts_;
  std::vector<Front> fronts_;
  std::vector<int> first_front_;  // per level, and the end
  std::vector<int> front_of_;     // front of each unknown
};

/// subtract_product(): subtracts a front's blocks times x (unknowns) from the rows (unknowns);
/// add_absolute_product(): adds the product of absolute values.
void subtract_product(const Front& front, const double* blocks, const double* x, double* rows);
void add_absolute_product(const Front& front, const double* blocks, const double* x, double* rows);

/// Replaces the blocks of a front by their factors; the remainders of fronts behind it must have been
/// subtracted. False where a pivot is zero or not finite.
[[nodiscard]] bool factorise(const Front& front, double* blocks);
/// Subtracts the remainder of a factorised front from the blocks of the front before.
void take_from_parent(const Front& front, const Front& parent, double* blocks);
/// Solves for the unknowns of a front: first from outside in, then from inside out.
void solve_inwards(const Front& front, const double* blocks, double* x);
void solve_outwards(const Front& front, const double* blocks, double* x);

}  // namespace nurbeam
