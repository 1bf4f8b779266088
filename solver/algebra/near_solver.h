#pragma once
#include <Eigen/SparseCore>
#include <deque>
#include <functional>
#include <limits>
#include <vector>

#include "solver/algebra/kkt_solver.h"

namespace nurbeam {

/// Where nothing has been corrected yet.
inline constexpr double unknown_contraction = std::numeric_limits<double>::infinity();
/// Corrects x until A x = b but for `tolerance` of its largest number, among `coordinates` and among the
/// others behind them, with factors of a matrix near A. `open`: finds b - A x; `contraction`: by how much the
/// second correction is smaller than the first, where that is known of an A before this one, so that one may
/// do. Returns false where corrections do not become smaller fast, and x means nothing.
[[nodiscard]] bool correct_solution(
    const KktSolver& factors,
    const std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& open)>& open, double tolerance,
    Eigen::Index coordinates, Eigen::VectorXd& x, double& contraction);

/// Solves with matrices of which one lies close to the next, as those of neighbouring systems: the factors of
/// one serve the others, by corrections of the solution before to round-off, as long as these converge fast.
class NearSolver {
 public:
  /// x with A x = b, with factors of `A` itself where there are no others of its size that serve. `A`:
  /// compressed; `last`: as `part` of KktSolver::factorise. Returns false where A is not regular.
  [[nodiscard]] bool solve(const SparseView& A, const std::vector<int>& last, const Eigen::VectorXd& b,
                           Eigen::VectorXd& x);

 private:
  KktSolver solver_;
  Eigen::Index rows_ = 0, entries_ = 0;  // of the matrix that has been factorised, 0: none
  Eigen::VectorXd x_;                    // the last solution
};

/// What has been solved for one motion, by which its neighbours are found.
struct NeighbourSolver {
  KktSolver factors;
  Eigen::VectorXd solution = {};  ///< empty: nothing has
  double scale = 1;               ///< by which the rows of coordinates were divided
};
/// Of several systems that are solved one after the other.
using NeighbourSolvers = std::deque<NeighbourSolver>;

}  // namespace nurbeam
