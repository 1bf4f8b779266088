#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "solver/algebra/banded_lu.h"
#include "solver/algebra/sparse_lu.h"

namespace nurbeam {

/// A few machine epsilons: cancellation leaves as much of a pivot that is zero in exact arithmetic.
inline constexpr double smallest_reciprocal_condition = 1e-15;

/// The order of a strand: unknowns that are coupled with no others but those of the part eliminated last, in
/// the order of their elimination.
struct StrandOrder {
  /// An entry of B (row of A, column of S) or of C (column of A, row of S).
  struct Entry {
    int value, place, part;  ///< index among the matrix's values; place in A; place in S
  };

  /// `in_part`: place of each unknown in the part, or -1.
  StrandOrder(const SparseView& matrix, BandOrder of, const std::vector<int>& in_part);

  std::shared_ptr<const BandOrder> band;
  std::vector<Entry> into, out_of;  ///< by part, then by place
};

/// The factors of a strand, A = L U, with V = L^-1 B and W = C U^-1. They are banded, or KLU's; with KLU L
/// stands for A, and U is 1.
class Strand {
 public:
  Strand(std::shared_ptr<const StrandOrder> order, const SparseView& matrix);
  ~Strand();
  Strand(Strand&&) noexcept;

  /// Factorises A, and finds V and W, with `part` columns and rows. Returns whether A is regular.
  bool factorise(const SparseView& matrix, std::size_t part);
  /// Subtracts W V from the remainder of S.
  void take_from(Eigen::MatrixXd& schur) const;

  /// The banded factors, if the strand has a narrow band, else null.
  const BandedLu* banded() const { return is_banded_ ? &lu_ : nullptr; }
  /// Sets y = L^-1 b for the strand's share of a right-hand side.
  void lower(const Eigen::VectorXd& rhs);
  /// W y in one row.
  double beside(std::size_t part) const;
  /// x = U^-1 (y - V x_part) for the strand's unknowns, with the solution of the part given.
  void upper(const Eigen::VectorXd& part, Eigen::VectorXd& x);

 private:
  // A row of W or a column of V: zero before `first`.
  struct Piece {
    int first = 0;
    std::vector<double> values;
  };

  Eigen::Index size() const { return static_cast<Eigen::Index>(order_->band->unknown.size()); }
  const BandOrder& band() const { return *order_->band; }
  void extract(const SparseView& matrix);
  double factors(const SparseView& matrix);
  void solve_whole(BandedLu::Places& y) const;
  void keep(Piece& piece, int first, int last);
  static double product(const Piece& a, const Piece& b);

  std::shared_ptr<const StrandOrder> order_;
  bool is_banded_ = false, is_structurally_regular_ = true;
  BandedLu lu_;
  std::unique_ptr<SparseLu<double>> sparse_lu_;
  Eigen::SparseMatrix<double> matrix_;  // the matrix for KLU
  std::vector<Piece> into_, out_of_;    // V by columns, W by rows
  BandedLu::Places y_;
};

}  // namespace nurbeam
