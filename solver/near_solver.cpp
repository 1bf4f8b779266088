#include "solver/near_solver.h"

#include <limits>

namespace nurbeam {

bool correct_solution(const KktSolver& factors,
                      const std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& open)>& open,
                      double tolerance, Eigen::VectorXd& x) {
  constexpr double fast = 1e-2;  // than which corrections must become smaller, each over the one before
  constexpr int most = 8;
  Eigen::VectorXd left(x.size()), correction;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most; ++i) {
    open(x, left);
    factors.solve(left, correction);
    if (!correction.allFinite()) return false;
    x += correction;
    const double now = correction.lpNorm<Eigen::Infinity>();
    if (now == 0) return true;
    if (!(now <= fast * before)) return false;
    // What is left is smaller than the correction as much as this is than the one before.
    if (i > 0 && now / before * now <= tolerance * x.lpNorm<Eigen::Infinity>()) return true;
    before = now;
  }
  return false;
}

bool NearSolver::solve(const SparseView& A, const std::vector<int>& last, const Eigen::VectorXd& b,
                       Eigen::VectorXd& x) {
  constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
  const auto open = [&](const Eigen::VectorXd& of, Eigen::VectorXd& left) {
    left = b;
    left.noalias() -= A * of;
  };
  const bool is_near = rows_ > 0 && A.rows() == rows_ && A.nonZeros() == entries_;
  if (!is_near || !correct_solution(solver_, open, round_off, x_)) {
    rows_ = 0;
    if (!solver_.factorise(A, last)) return false;
    x_ = solver_.solve(b);
    rows_ = A.rows();
    entries_ = A.nonZeros();
  }
  x = x_;
  return true;
}

}  // namespace nurbeam
