#pragma once
#include "solver/algebra/kkt_solver.h"

namespace nurbeam {

/// [[B, G'], [G, 0]] with B n x n, factorised with rows and columns of about one size: stiff and soft members
/// beside constraints of any unit.
class EquilibratedKkt {
 public:
  EquilibratedKkt(const Eigen::SparseMatrix<double>& kkt, int n);

  bool regular() const { return regular_; }
  Eigen::Index size() const { return factor_.size(); }
  /// (n + m) Precondition: regular().
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;
  /// (n + m) Solutions for many right-hand sides, a column each. Precondition: regular().
  KktSolver::Columns solutions(const KktSolver::Columns& rhs) const;

 private:
  Eigen::VectorXd factor_;
  KktSolver solver_;
  bool regular_;
};

/// (n + m) Factors d that bring the largest entry of each row and column of B, and of each row of G, in
/// diag(d) [[B, G'], [G, 0]] diag(d) to about 1.
Eigen::VectorXd equilibration(const Eigen::SparseMatrix<double>& kkt, int n);
/// diag(d) kkt diag(d), compressed.
Eigen::SparseMatrix<double> scaled(const Eigen::SparseMatrix<double>& kkt, const Eigen::VectorXd& d);

}  // namespace nurbeam
