#include "solver/near_solver.h"

#include <limits>

namespace nurbeam {

bool NearSolver::solve(const Eigen::SparseMatrix<double>& A, const std::vector<int>& last,
                       const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  const bool is_near = rows_ > 0 && A.rows() == rows_ && A.nonZeros() == entries_;
  if (!is_near || !correct(A, b)) {
    rows_ = 0;
    if (!solver_.factorise(A, last)) return false;
    x_ = solver_.solve(b);
    rows_ = A.rows();
    entries_ = A.nonZeros();
  }
  x = x_;
  return true;
}

// Whether that has converged; the last solution means nothing where it has not.
bool NearSolver::correct(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& b) {
  constexpr double fast = 1e-2;  // than which corrections must become smaller, each over the one before
  constexpr int most = 8;
  constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
  Eigen::VectorXd open(b.size()), correction;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most; ++i) {
    open = b;
    open.noalias() -= A * x_;
    solver_.solve(open, correction);
    if (!correction.allFinite()) return false;
    x_ += correction;
    const double now = correction.lpNorm<Eigen::Infinity>();
    if (now == 0) return true;
    if (!(now <= fast * before)) return false;
    // What is left is smaller than the correction as much as this is than the one before.
    if (i > 0 && now / before * now <= round_off * x_.lpNorm<Eigen::Infinity>()) return true;
    before = now;
  }
  return false;
}

}  // namespace nurbeam
