#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <optional>

namespace nurbeam {

/// theta and x of A x = theta B x + G'y, G x = 0: theta of the largest magnitude first.
struct Eigenpairs {
  Eigen::VectorXd values;   ///< (count)
  Eigen::MatrixXd vectors;  ///< (n x count), x'B x = 1
};

/// The `count` theta of the largest magnitude, fewer where others are zero. A (n x n) is symmetric, `kkt` is
/// [[B, G'], [G, 0]] with B symmetric and positive definite where G x = 0. The method is the implicitly
/// restarted Lanczos method (Spectra) with sparse factors of `kkt` and of B + w G'G. One start vector finds
/// one of equal eigenvalues, so that the method is started again beside the found ones until none is missing.
///
/// Nothing is returned where `kkt` is singular, B is not as required, or the iteration does not converge.
/// `between` is called before every product with A; its exceptions arrive unchanged.
std::optional<Eigenpairs> largest_eigenpairs(
    const Eigen::SparseMatrix<double>& A, const Eigen::SparseMatrix<double>& kkt, int count,
    const std::function<void()>& between = [] {});

}  // namespace nurbeam
