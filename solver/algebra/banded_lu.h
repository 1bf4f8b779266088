#pragma once
#include <array>
#include <memory>
#include <vector>

#include "solver/algebra/band_order.h"

namespace nurbeam {

/// LU with threshold pivoting for one matrix pattern whose unknowns are few levels apart, as those of a chain
/// of elements. The unknowns are put into a narrow order and eliminated within the band.
class BandedLu {
 public:
  static constexpr int block = 4;  ///< unknowns that are eliminated together
  /// Four numbers that follow one another, anywhere in memory.
  using Four = double __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));

  /// Makes room for matrices whose pattern has this order.
  void take(std::shared_ptr<const BandOrder> order);

  /// Row-scales and factorises the ordered part of a matrix of the pattern, R A = P L U with the scales R and
  /// row exchanges P. The matrix must be compressed and finite. Returns the smallest over the largest pivot.
  double factorise(const SparseView& matrix);
  /// Numbers by places for the steps of a solution, with room for the reach of blocks beyond the end.
  using Places = std::vector<double>;
  Places places() const { return Places(room_, 0); }
  /// Loads R b for a right-hand side b, by unknowns.
  void load(const Eigen::VectorXd& rhs, Places& y) const;
  double scale(int place) const { return scale_[static_cast<std::size_t>(place)]; }
  /// y <- (P L)^-1 y.
  void lower(Places& y) const;
  /// y <- (P L)^-1 y, where y is zero except from place `first` to `last`; `last` becomes the last nonzero
  /// place.
  void lower(Places& y, int first, int& last) const;
  /// y <- U^-1 y.
  void upper(Places& y) const;
  /// y <- U^-T y, where y is zero except from place `first` to `last`; `last` becomes the last nonzero place.
  void upper_transposed(Places& y, int first, int& last) const;

  /// Right-hand sides or solutions, a column each.
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// A^-1 times many right-hand sides, by unknowns; twenty at a time. Precondition: the order leaves none
  /// out.
  void solve(const Columns& rhs, Columns& x) const;

 private:
  // The rows that are being eliminated: from a column's own row to the last row coupled with it.
  class Window;

  double eliminate_rows(const SparseView& matrix);
  static std::ptrdiff_t append(int count, std::size_t& end, std::vector<double>& numbers);
  void keep_block(int k, Window& window);
  void invert_upper(int k, Window& window);
  void invert_lower(int k, Window& window);
  std::array<const double*, 4> upper_beyond(int k) const;
  std::array<const double*, 4> multipliers_beyond(int k) const;
  void take_out(int k, const Four& x, double* y) const;
  template <class Exchange, class TakeOff>
  void eliminate_exchanged(int k, const Exchange& exchange, const TakeOff& take_off) const;
  class Elimination;
  template <int times>
  void lower_beside(double* y) const;
  template <int times>
  void upper_beside(double* y) const;
  void solve_fours(int times, double* y) const;

  std::shared_ptr<const BandOrder> order_;
  int half_bandwidth_ = 0;
  int padded_ = 0;  ///< number of unknowns, including those that fill the last block
  /// A block of four on the diagonals: D of U and C of L. Beside it stand E of U to its right and B of L to
  /// its left. Stored are the columns of the inverses and of their products with E and B. So one block waits
  /// for the next no longer than one product takes.
  ///
  /// Where rows are exchanged the elimination has to wait for each row. The members then hold C and B instead
  /// of C^-1 and C^-1 B, and the next block holds its B too.
  struct Block {
    using Square = std::array<std::array<double, 4>, 4>;
    Square inverses;       ///< D^-1, and below its diagonal C^-1, whose diagonal is of ones
    Square from_next;      ///< D^-1 E
    Square from_previous;  ///< C^-1 B
    std::ptrdiff_t upper_begin, lower_begin;  ///< where its rows of U and its columns of L begin
    int upper_length, lower_length;           ///< length of each of them
    int reach;                                ///< last row that the block's multipliers change
    bool exchanged;                           ///< whether rows were exchanged
  };
  std::vector<Block> blocks_;
  std::vector<double> upper_;  ///< four rows of U at a time, from beyond the next block on
  std::vector<double> lower_;  ///< four columns of multipliers at a time, from beyond the next block on
  std::size_t upper_end_ = 0, lower_end_ = 0;  ///< ends of the numbers in upper_ and lower_
  std::vector<double> scale_;                  ///< per row of the matrix
  std::vector<int> pivots_;                    ///< row that was brought to each place
  std::unique_ptr<double[]> window_;           ///< room for the rows that are being eliminated
  std::unique_ptr<int[]> window_ends_;         ///< ends of these rows
  std::size_t room_ = 0;
};

}  // namespace nurbeam
