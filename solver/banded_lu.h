#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <memory>
#include <vector>

namespace nurbeam {

/// An order of the unknowns of a square pattern, which should be symmetric: else the order is poor, not
/// wrong. As they are numbered where that is narrow (close_order), else the reverse order of Cuthill and
/// McKee.
struct BandOrder {
  /// Of all unknowns but those `left_out`. What is coupled with these comes last in its component where that
  /// makes no wider band.
  explicit BandOrder(const Eigen::SparseMatrix<double>& pattern, const std::vector<int>& left_out = {});
  /// Of these unknowns alone, in the order in which they come.
  static BandOrder of(const Eigen::SparseMatrix<double>& pattern, std::vector<int> unknowns);

  std::vector<int> unknown;  ///< at each place of the order
  std::vector<int> place;    ///< of each unknown, -1 where it is left out
  std::vector<int> ends;     ///< one past the last column of each row, by places
  std::vector<int> below;    ///< last row that has an entry in a column, or in one before it
  int half_bandwidth = 0;    ///< greatest distance of an entry from the diagonal

  /// An entry: its column, by places, and its index among the values of the pattern.
  struct Entry {
    int column, value;
  };
  std::vector<Entry> entries;   ///< row by row
  std::vector<int> row_starts;  ///< of each row in `entries`, and the end

 private:
  BandOrder() = default;
  void place_unknowns(const Eigen::SparseMatrix<double>& pattern);
};

/// LU with threshold pivoting of one matrix pattern whose unknowns are few levels apart, as those of a chain
/// of elements are: they are put into such an order and eliminated within the band.
class BandedLu {
 public:
  /// Four numbers that follow one another, anywhere.
  using Four = double __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));

  /// Makes room for matrices of the pattern that has this order.
  void take(std::shared_ptr<const BandOrder> order);

  /// Row-scales and factorises what the order holds of a matrix of that pattern, R A = P L U with the scales
  /// R and row exchanges P; `compressed`, and finite. Returns the smallest over the largest pivot.
  double factorise(const Eigen::SparseMatrix<double>& matrix);
  /// Numbers by places that the steps of a solution take, with room for what blocks reach beyond.
  using Places = std::vector<double>;
  Places places() const { return Places(room_, 0); }
  /// R b of a right-hand side b, by unknowns.
  void load(const Eigen::VectorXd& rhs, Places& y) const;
  double scale(int place) const { return scale_[static_cast<std::size_t>(place)]; }
  /// y <- (P L)^-1 y.
  void lower(Places& y) const;
  /// The same where y is zero but from place `first` to `last`, which becomes the last one that is not.
  void lower(Places& y, int first, int& last) const;
  /// y <- U^-1 y.
  void upper(Places& y) const;
  /// y <- U^-T y, where y is zero but from place `first` to `last`, which becomes the last one that is not.
  void upper_transposed(Places& y, int first, int& last) const;

  /// Right-hand sides or solutions, a column each.
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// A^-1 of many right-hand sides, by unknowns; sixteen or four at a time. Precondition: the order leaves
  /// none out.
  void solve(const Columns& rhs, Columns& x) const;

 private:
  double* diagonal(int i) { return band_.get() + diagonal_[i]; }
  const double* diagonal(int i) const { return band_.get() + diagonal_[i]; }
  void fill_band(const Eigen::SparseMatrix<double>& matrix);
  int pivot_of(int column, int last) const;
  void exchange(int k, int p);
  void take_out(int k, int last);
  double eliminate_rows();
  std::array<const double*, 4> multipliers(int k) const;
  void take_out(int k, const Four& x, int first, double* y) const;
  void eliminate(int k, double* all) const;
  void invert_upper(int k);
  void invert_lower(int k);
  template <int times>
  void solve_beside(double* y) const;
  void solve_sixteen(double* y) const;
  void solve_four(double* y) const;

  std::shared_ptr<const BandOrder> order_;
  int half_bandwidth_ = 0;
  int padded_ = 0;                           ///< unknowns with those that fill the last block: rows of one
  std::unique_ptr<double[]> band_;           ///< what is left to eliminate, then U
  std::vector<std::ptrdiff_t> row_begin_;    ///< of each row in the band, and the end
  std::vector<std::ptrdiff_t> diagonal_;     ///< of each row in the band
  std::vector<double> lower_;                ///< multipliers below the diagonal of each column
  std::vector<std::ptrdiff_t> lower_begin_;  ///< of each column in them, and the end
  std::vector<double> inverse_;              ///< of each pivot
  /// Of a block of four on the diagonals, D of U and C of L, and what stands beside it, E of U to its right
  /// and B of L to its left: columns of inverses and of these times what it takes from the blocks next to it,
  /// so that one waits for the other no longer than one product takes.
  struct Block {
    std::array<std::array<double, 4>, 4> upper, from_next;      ///< D^-1, D^-1 E
    std::array<std::array<double, 4>, 4> lower, from_previous;  ///< C^-1, C^-1 B where rows stay
    bool exchanged;                                             ///< rows with others: then none of the second
  };
  std::vector<Block> blocks_;
  std::vector<double> scale_;  ///< of each row of the matrix
  std::vector<int> pivots_;    ///< row that was brought to each place
  std::vector<int> reach_;     ///< last row that a block of four columns of multipliers changes
  std::vector<int> ends_;      ///< one past the last column of each row of what is left, then of U
  std::size_t room_ = 0;
};

}  // namespace nurbeam
