#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "solver/kkt_solver.h"

namespace nurbeam {

/// LU of a matrix K of which a small part changes without a new factorisation (Sherman, Morrison & Woodbury):
/// with E the columns of the unit matrix that belong to p unknowns, D (p x p) the change of their rows and
/// columns, and Z = K^-1 E,
///   (K + E D E')^-1 = K^-1 - Z (1 + D E'Z)^-1 D E'K^-1.
class UpdatedKkt {
 public:
  /// K, as KktSolver does it, and the unknowns whose rows and columns will change; nothing has changed yet.
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& unknowns);
  /// D: by what the part is now more than it was in K. Returns whether all is finite.
  [[nodiscard]] bool update(const Eigen::MatrixXd& change);
  /// x with (K + E D E') x = rhs. Precondition: what came before returned true.
  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const;

 private:
  KktSolver solver_;
  std::vector<int> unknowns_;
  bool has_columns_ = false, is_changed_ = false;
  Eigen::MatrixXd change_;   ///< D
  Eigen::MatrixXd columns_;  ///< Z (n x p), once something has changed
  Eigen::MatrixXd core_;     ///< 1 + D E'Z
  Eigen::PartialPivLU<Eigen::MatrixXd> inner_;
  mutable Eigen::VectorXd at_part_, taken_;  ///< of solve
};

}  // namespace nurbeam
