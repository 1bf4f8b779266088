#pragma once
#include <span>
#include <vector>

#include "solver/algebra/coupling_levels.h"

namespace nurbeam {

/// Unknowns of one level that are eliminated together, and the front of the level before that gets what is
/// left: all of that level with which they are coupled. Unknowns by their places, one front after the other.
struct Front {
  int first, own;            ///< its unknowns
  int first_before, before;  ///< those of the other front
  int parent;                ///< that one, -1: there is none
  /// Where its blocks begin among those of all, one after the other and each row by row: of its own rows the
  /// columns of its own (own, own) and of those before (own, before), and of the rows before its own columns
  /// (before, own).
  int blocks;

  int upper() const { return blocks + own * own; }
  int lower() const { return upper() + own * before; }
  int end() const { return lower() + before * own; }
};

/// The fronts of unknowns in levels, eliminated from outside in: those of each level that are coupled there,
/// or by what has been eliminated, are in one.
class Fronts {
 public:
  Fronts(const SparsePattern& pattern, const CouplingLevels& levels);

  /// Level by level, front by front.
  const std::vector<int>& unknowns() const { return unknowns_; }
  /// First unknown of a level, and the end.
  int start(int level) const { return starts_[level]; }
  int level_count() const { return static_cast<int>(starts_.size()) - 1; }
  std::span<const Front> of_level(int level) const {
    return {fronts_.data() + first_front_[level], fronts_.data() + first_front_[level + 1]};
  }
  std::span<const Front> all() const { return fronts_; }
  /// How many numbers all blocks hold.
  int block_size() const { return fronts_.back().end(); }
  /// Where the blocks hold what is in a row and a column, by their places; -1: nowhere.
  int index(int row, int column) const;

 private:
  std::vector<int> unknowns_, starts_;
  std::vector<Front> fronts_;
  std::vector<int> first_front_;  // of each level, and the end
  std::vector<int> front_of_;     // each unknown
};

/// What is left in the rows (unknowns) less a front's blocks times x (unknowns); with absolute values: what
/// they add there.
void subtract_product(const Front& front, const double* blocks, const double* x, double* rows);
void add_absolute_product(const Front& front, const double* blocks, const double* x, double* rows);

/// Puts the factors of a front into the place of its blocks, from which what fronts behind it have left has
/// been taken. False where one of its pivots is none.
[[nodiscard]] bool factorise(const Front& front, double* blocks);
/// Takes what a front that has been factorised leaves from the blocks of the one before.
void take_from_parent(const Front& front, const Front& parent, double* blocks);
/// Solves for the unknowns of a front: from outside in, then from inside out.
void solve_inwards(const Front& front, const double* blocks, double* x);
void solve_outwards(const Front& front, const double* blocks, double* x);

}  // namespace nurbeam
