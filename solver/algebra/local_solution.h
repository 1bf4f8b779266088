#pragma once
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// Corrects x until A x = b to round-off. If only few rows are open, and corrections fade away from them, as
/// in mass matrices, only the unknowns around them are solved for: as many as it takes, if need be all. `A`:
/// compressed, with a symmetric pattern; `last`: as `part` of KktSolver::factorise. Returns false, x
/// unchanged, where A is singular.
[[nodiscard]] bool correct_locally(const SparseView& A, const Eigen::VectorXd& b,
                                   const std::vector<int>& last, Eigen::VectorXd& x);

/// The rows and columns of these unknowns, in order.
Eigen::SparseMatrix<double> submatrix(const SparseView& A, const std::vector<int>& unknowns);

}  // namespace nurbeam
