#pragma once
#include <Eigen/SparseCore>
#include <deque>
#include <functional>
#include <limits>
#include <vector>

#include "solver/algebra/kkt_solver.h"

namespace nurbeam {

/// The contraction before any correction.
inline constexpr double unknown_contraction = std::numeric_limits<double>::infinity();
/// Corrects x until A x = b, with factors of a matrix near A. The error is at most `tolerance` of the largest
/// number, both among `coordinates` and among the unknowns behind them. `open`: finds b - A x; `contraction`:
/// of the second correction over the first, if known from an A before this one, so that one correction may
/// do. Returns false where corrections do not shrink fast; x then means nothing.
[[nodiscard]] bool correct_solution(
    const KktSolver& factors,
    const std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& open)>& open, double tolerance,
    Eigen::Index coordinates, Eigen::VectorXd& x, double& contraction);

/// A solver for matrices each of which is close to the next, as those of neighbouring systems. The factors of
/// one serve the others, by corrections of the last solution to round-off, as long as these converge fast.
class NearSolver {
 public:
  /// x with A x = b. A itself is factorised where no factors of its size serve. `A`: compressed; `last`: as
  /// `part` of KktSolver::factorise. Returns false where A is not regular.
  [[nodiscard]] bool solve(const SparseView& A, const std::vector<int>& last, const Eigen::VectorXd& b,
                           Eigen::VectorXd& x);

 private:
  KktSolver solver_;
  Eigen::Index rows_ = 0, entries_ = 0;  // size of the factorised matrix, 0: none
  Eigen::VectorXd x_;                    // the last solution
};

/// The factors and the solution for one motion, by which its neighbours are found.
struct NeighbourSolver {
  KktSolver factors;
  Eigen::VectorXd solution = {};  ///< empty: nothing was solved yet
  double scale = 1;               ///< divisor of the rows of coordinates
};
/// Solvers of several systems that are solved one after the other.
using NeighbourSolvers = std::deque<NeighbourSolver>;

}  // namespace nurbeam
