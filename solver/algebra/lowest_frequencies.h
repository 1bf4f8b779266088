#pragma once
#include <Eigen/SparseCore>
#include <functional>
#include <optional>
#include <vector>

namespace nurbeam {

/// Eigenpairs of K x = omega^2 M x + G'y, G x = 0.
struct SquaredFrequencies {
  Eigen::VectorXd values;  ///< omega^2, increasing [1/s^2]
  Eigen::MatrixXd shapes;  ///< (n, values) x'M x = 1
  double resolution = 0;   ///< what the way in which they are found leaves of one that vanishes
};

/// The lowest `count` of them, of [[K, G'], [G, 0]] and [[M, G'], [G, 0]] with K and M n x n: by the inverse
/// of K + shift M, with a shift that is a hundredth of the last one, whatever that is. Nothing where they are
/// not found. `between` is called all along, and may throw.
std::optional<SquaredFrequencies> lowest_frequencies(const Eigen::SparseMatrix<double>& stiffness_kkt,
                                                     const Eigen::SparseMatrix<double>& mass_kkt, int n,
                                                     int count, const std::function<void()>& between);

/// What of squared frequency `i` is round-off of the sum x'K x: those of rigid motions are up to 0.6 of it
/// off, of bars and arcs of 5 to 1500 elements [1/s^2].
double round_off(const SquaredFrequencies& found, Eigen::Index i,
                 const Eigen::SparseMatrix<double>& stiffness);
/// Which of them cannot be told from 0, for these round-offs or by the way in which they were found.
std::vector<bool> rigid_motions(const SquaredFrequencies& found, const std::vector<double>& round_off);

}  // namespace nurbeam
