#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "solver/near_solver.h"
#include "solver/sparse_pattern.h"

namespace nurbeam {

/// Corrects x until A x = b to round-off. Where only few rows are open, and what closes them fades away from
/// there, as in matrices of masses, only the unknowns around them are solved for: as many as it takes, if
/// need be all. `A`: compressed, its pattern symmetric; `last`: as `part` of KktSolver::factorise. Returns
/// false, x unchanged, where A is singular.
[[nodiscard]] bool correct_locally(const SparseView& A, const Eigen::VectorXd& b,
                                   const std::vector<int>& last, Eigen::VectorXd& x);

/// The rows and columns of these unknowns, in order.
Eigen::SparseMatrix<double> submatrix(const Eigen::Map<const Eigen::SparseMatrix<double>>& A,
                                      const std::vector<int>& unknowns);
Eigen::SparseMatrix<double> submatrix(const SparseView& A, const std::vector<int>& unknowns);

/// Unknowns of a symmetric pattern, those first that are coupled with some over the fewest others.
struct Surroundings {
  std::vector<int> unknowns;  ///< two levels beyond the reach
  std::size_t inner, rows;    ///< how many of these are within it, and one level beyond

  Surroundings(const SparsePattern& pattern, const std::vector<int>& around, int reach);
};

enum class Beyond {
  closed,  ///< the rows next to the unknowns that are solved for must stay closed, to round-off
  given    ///< what x holds beyond is given, whatever it leaves open there
};
/// Corrects the inner ones of x until their rows of A x = b are closed to round-off. `A`: right in the rows
/// of the first `around.rows` alone. Returns false, x unchanged, where it has no regular matrix of the inner
/// ones, or where they do not suffice.
[[nodiscard]] bool correct_around(const Eigen::Map<const Eigen::SparseMatrix<double>>& A,
                                  const Eigen::VectorXd& b, const Surroundings& around, Beyond beyond,
                                  NearSolver& solver, Eigen::VectorXd& x);

}  // namespace nurbeam
