#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace nurbeam {

/// The reverse order of Cuthill and McKee of the unknowns of a square pattern, which should be symmetric:
/// else the order is poor, not wrong.
struct BandOrder {
  explicit BandOrder(const Eigen::SparseMatrix<double>& pattern);

  std::vector<int> unknown;  ///< at each place of the order
  std::vector<int> place;    ///< of each unknown
  std::vector<int> ends;     ///< one past the last column of each row, by places
  int half_bandwidth = 0;    ///< greatest distance of an entry from the diagonal
};

/// LU with threshold pivoting of one matrix pattern whose unknowns are few levels apart, as those of a chain
/// of elements are: they are put into such an order and eliminated within the band.
class BandedLu {
 public:
  /// Makes room for matrices of the pattern that has this order.
  void take(std::shared_ptr<const BandOrder> order);

  /// Row-scales and factorises a matrix of that pattern; `compressed`, and finite. Returns the smallest over
  /// the largest pivot.
  double factorise(const Eigen::SparseMatrix<double>& matrix);
  /// x with matrix x = rhs.
  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const;
  /// (n x p) the columns of the inverse that belong to p unknowns, side by side.
  void solve_units(const std::vector<int>& unknowns, Eigen::MatrixXd& columns) const;

 private:
  double* row(int i) { return band_.data() + static_cast<std::size_t>(i) * width_; }
  const double* row(int i) const { return band_.data() + static_cast<std::size_t>(i) * width_; }
  void fill_band(const Eigen::SparseMatrix<double>& matrix);
  int pivot_of(int column) const;
  void eliminate(int k) const;
  void substitute(int k) const;

  std::shared_ptr<const BandOrder> order_;
  int half_bandwidth_ = 0;
  int padded_ = 0;                 ///< unknowns with those that fill the last block: rows of one
  int width_ = 0;                  ///< of a row in storage: columns i - b to i + 2 b, and zeros
  int height_ = 0;                 ///< of a column of multipliers: b, and zeros
  std::vector<double> band_;       ///< what is left to eliminate, then U
  std::vector<double> lower_;      ///< multipliers below the diagonal of each column
  std::vector<double> inverse_;    ///< of each pivot
  std::vector<double> scale_;      ///< of each row of the matrix
  std::vector<int> pivots_;        ///< row that was brought to each place
  std::vector<int> reach_;         ///< last row that a block of four columns of multipliers changes
  std::vector<int> ends_;          ///< one past the last column of each row of what is left, then of U
  mutable std::vector<double> y_;  ///< of solve
  mutable std::vector<Eigen::Array4d> four_;  ///< of solve_units
};

}  // namespace nurbeam
