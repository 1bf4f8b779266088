#pragma once
#include <Eigen/SparseCore>
#include <memory>

namespace nurbeam {

/// Sparse LU (KLU) of one matrix pattern: symbolic analysis once, numeric factorisation as often as wanted.
class KktSolver {
 public:
  KktSolver();
  ~KktSolver();
  KktSolver(KktSolver&&) noexcept;
  KktSolver& operator=(KktSolver&&) noexcept;

  /// Analyses the pattern on first use (or when its size or number of entries changed), then factorises.
  /// Returns whether the matrix is numerically non-singular.
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& matrix);
  /// x with matrix x = rhs. Precondition: factorise returned true.
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nurbeam
