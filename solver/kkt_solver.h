#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace nurbeam {

/// LU of one matrix pattern: symbolic analysis once, numeric factorisation as often as wanted. Within a band
/// where the unknowns can be put into a narrow one, else by KLU.
class KktSolver {
 public:
  KktSolver();
  ~KktSolver();
  KktSolver(KktSolver&&) noexcept;
  KktSolver& operator=(KktSolver&&) noexcept;

  /// Analyses the pattern on first use (and when its size or its index arrays changed), then factorises the
  /// compressed, square `matrix`.
  /// Returns whether the matrix is finite and numerically non-singular: smallest over largest pivot of the
  /// row-scaled factors above 1e-15.
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& matrix);
  /// x with matrix x = rhs. Precondition: factorise returned true.
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;
  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const;
  /// (n x p) the columns of the inverse that belong to p unknowns.
  void solve_units(const std::vector<int>& unknowns, Eigen::MatrixXd& columns) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nurbeam
