#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <optional>

namespace nurbeam {

/// The stability of an equilibrium by its tangent: stable where K is positive definite on the null space of
/// G.
struct Stability {
  int unstable_directions = 0;  ///< number of negative eigenvalues of K on the null space of G; for
                                ///< divergence(): 1 if there are any
  /// (n) An unstable direction, of unit length; empty where there is none.
  Eigen::VectorXd direction = {};
};

/// Whether K (n x n) of [[K, G'], [G, 0]] is symmetric to round-off; otherwise there is no energy.
bool is_symmetric(const Eigen::SparseMatrix<double>& kkt, int n);

/// The stability by [[K, G'], [G, 0]] with K n x n. Eigenvalues that may be round-off count as zero. Nothing
/// where K is not symmetric (follower loads): there is no energy.
std::optional<Stability> stability(const Eigen::SparseMatrix<double>& kkt, int n);

/// The stability by an unsymmetric K. An equilibrium is stable if no eigenvalue of K x = lambda M x + G'y, G
/// x = 0 has a negative real part; with such an eigenvalue it is left, whatever damping by M acts. Complex
/// eigenvalues with a positive real part (flutter) belong to motions that damping may end, and count as
/// stable. `mass` (n x n) may be singular, and is asked for only where the symmetric part of K is not
/// positive definite.
Stability divergence(const Eigen::SparseMatrix<double>& kkt, int n,
                     const std::function<Eigen::SparseMatrix<double>()>& mass);

}  // namespace nurbeam
