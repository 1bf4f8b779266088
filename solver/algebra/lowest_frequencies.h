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
  double resolution = 0;   ///< error of a vanishing omega^2 by the method [1/s^2]
};

/// The lowest `count` squared frequencies of [[K, G'], [G, 0]] and [[M, G'], [G, 0]] with K and M n x n. They
/// come from the inverse of K + shift M; the shift is a hundredth of the last one, whatever that is. Nothing
/// where they are not found. `between` is called all along, and may throw.
std::optional<SquaredFrequencies> lowest_frequencies(const Eigen::SparseMatrix<double>& stiffness_kkt,
                                                     const Eigen::SparseMatrix<double>& mass_kkt, int n,
                                                     int count, const std::function<void()>& between);

/// Round-off of squared frequency `i`, from the sum x'K x [1/s^2]. For bars and arcs of 5 to 1500 elements
/// the squared frequencies of rigid motions reach 0.6 of it.
double round_off(const SquaredFrequencies& found, Eigen::Index i,
                 const Eigen::SparseMatrix<double>& stiffness);
/// Per frequency: whether it cannot be told from 0, by these round-offs or by the error of the method.
std::vector<bool> rigid_motions(const SquaredFrequencies& found, const std::vector<double>& round_off);

}  // namespace nurbeam
