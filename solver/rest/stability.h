#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <optional>

namespace nurbeam {

/// What the tangent says of an equilibrium: it is stable where K is positive definite on the null space of G.
struct Stability {
  int unstable_directions = 0;  ///< negative eigenvalues of K there; of divergence(): 1 where there are some
  /// (n) One of them, of unit length; empty where there is none.
  Eigen::VectorXd direction = {};
};

/// Whether K (n x n) of [[K, G'], [G, 0]] is symmetric, but for round-off: else there is no energy.
bool is_symmetric(const Eigen::SparseMatrix<double>& kkt, int n);

/// Of [[K, G'], [G, 0]] with K n x n. What round-off may have made of zero counts as zero. Nothing where K is
/// not symmetric (follower loads): there is no energy.
std::optional<Stability> stability(const Eigen::SparseMatrix<double>& kkt, int n);

/// The same of a K that is not symmetric: stable is what has no eigenvalue of K x = lambda M x + G'y, G x = 0
/// with a negative real part. What has one leaves from rest, with any damping by M. Complex ones with a
/// positive real part (flutter) are those of motions that damping may end, and pass. `mass` (n x n) may be
/// singular, and is asked only where the symmetric part of K is not positive definite.
Stability divergence(const Eigen::SparseMatrix<double>& kkt, int n,
                     const std::function<Eigen::SparseMatrix<double>()>& mass);

}  // namespace nurbeam
