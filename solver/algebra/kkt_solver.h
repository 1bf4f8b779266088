#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// LU of one matrix pattern: symbolic analysis once, numeric factorisation as often as wanted. The factors
/// are banded where the unknowns can be put into a narrow band, else by KLU.
class KktSolver {
 public:
  KktSolver();
  ~KktSolver();
  KktSolver(KktSolver&&) noexcept;
  KktSolver& operator=(KktSolver&&) noexcept;

  /// Analyses the pattern on first use (and when its size or its index arrays or the part changed), then
  /// factorises the compressed, square `matrix`; `part`: the unknowns that are eliminated last, which must
  /// leave a matrix A that is regular.
  /// Returns whether the matrix is finite and numerically non-singular: smallest over largest pivot of the
  /// row-scaled factors above 1e-15.
  [[nodiscard]] bool factorise(const SparseView& matrix, const std::vector<int>& part = {});
  /// Adds `change` (p x p) to S as it was in the factorised matrix, in the order of the part. Returns as
  /// factorise does.
  [[nodiscard]] bool renew(const Eigen::MatrixXd& change);
  /// x with matrix x = rhs; x may be rhs itself. Precondition: the last factorise or renew returned true.
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;
  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const;
  /// Solutions for many right-hand sides, a column each.
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  void solve(const Columns& rhs, Columns& x) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nurbeam
