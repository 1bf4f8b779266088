#include "solver/algebra/near_solver.h"

#include <algorithm>
#include <limits>

namespace nurbeam {

namespace {

// The largest number of a part of a correction, relative to that of the corrected part; 0 where the
// correction is zero.
double relative_size(const Eigen::VectorXd& correction, const Eigen::VectorXd& x, Eigen::Index first,
                     Eigen::Index size) {
  const double of_correction = correction.segment(first, size).lpNorm<Eigen::Infinity>();
  return of_correction == 0 ? 0 : of_correction / x.segment(first, size).lpNorm<Eigen::Infinity>();
}

}  // namespace

bool correct_solution(const KktSolver& factors,
                      const std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& open)>& open,
                      double tolerance, Eigen::Index coordinates, Eigen::VectorXd& x, double& contraction) {
  constexpr double fast = 1e-2;  // limit for the ratio of each correction to the one before
  constexpr int most = 8;
  constexpr double slower = 100;  // limit for the growth of this ratio from one correction to the next
  const Eigen::Index others = x.size() - coordinates;
  Eigen::VectorXd left(x.size()), correction;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most; ++i) {
    open(x, left);
    factors.solve(left, correction);
    if (!correction.allFinite()) return false;
    x += correction;
    double now = relative_size(correction, x, 0, coordinates);
    if (others > 0) now = std::max(now, relative_size(correction, x, coordinates, others));
    if (now == 0) return true;
    if (!(now <= fast * before)) return false;
    if (i == 0) {
      contraction *= 2;  // A changes from one solution to the next
      if (contraction * now <= tolerance) return true;
    } else {
      if (i == 1) contraction = now / before;
      if (slower * now / before * now <= tolerance) return true;
    }
    before = now;
  }
  return false;
}

bool NearSolver::solve(const SparseView& A, const std::vector<int>& last, const Eigen::VectorXd& b,
                       Eigen::VectorXd& x) {
  constexpr double round_off = 6400 * std::numeric_limits<double>::epsilon();
  const auto open = [&](const Eigen::VectorXd& of, Eigen::VectorXd& left) {
    left = b;
    left.noalias() -= A * of;
  };
  double contraction = unknown_contraction;
  const bool is_near = rows_ > 0 && A.rows() == rows_ && A.nonZeros() == entries_;
  if (!is_near || !correct_solution(solver_, open, round_off, x_.size(), x_, contraction)) {
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
