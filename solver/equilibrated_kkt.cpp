#include "solver/equilibrated_kkt.h"

#include <algorithm>
#include <cmath>

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

}  // namespace

Vector equilibration(const Matrix& kkt, int n) {
  Vector largest = Vector::Zero(kkt.cols());
  for (int column = 0; column < n; ++column)
    for (Matrix::InnerIterator entry(kkt, column); entry; ++entry)
      if (entry.row() < n) largest[column] = std::max(largest[column], std::abs(entry.value()));
  Vector factor = (largest.array() > 0).select(largest.cwiseSqrt().cwiseInverse(), 1.0);
  Vector of_constraints = Vector::Zero(kkt.cols());
  for (int column = 0; column < n; ++column)
    for (Matrix::InnerIterator entry(kkt, column); entry; ++entry)
      if (entry.row() >= n)
        of_constraints[entry.row()] =
            std::max(of_constraints[entry.row()], std::abs(entry.value() * factor[column]));
  for (Eigen::Index i = n; i < kkt.cols(); ++i) factor[i] = of_constraints[i] > 0 ? 1 / of_constraints[i] : 1;
  return factor;
}

Matrix scaled(const Matrix& kkt, const Vector& d) {
  Matrix result = kkt;
  for (int column = 0; column < result.cols(); ++column)
    for (Matrix::InnerIterator entry(result, column); entry; ++entry)
      entry.valueRef() *= d[entry.row()] * d[column];
  result.makeCompressed();
  return result;
}

EquilibratedKkt::EquilibratedKkt(const Matrix& kkt, int n) : n_(n), factor_(equilibration(kkt, n)) {
  regular_ = solver_.factorise(scaled(kkt, factor_));
}

Vector EquilibratedKkt::solve(const Vector& rhs) const {
  return factor_.cwiseProduct(solver_.solve(factor_.cwiseProduct(rhs)));
}

KktSolver::Columns EquilibratedKkt::solutions(const KktSolver::Columns& rhs) const {
  KktSolver::Columns x;
  solver_.solve(factor_.asDiagonal() * rhs, x);
  return factor_.asDiagonal() * x;
}

Vector EquilibratedKkt::constrained_solve(const Vector& x) const {
  Vector rhs = Vector::Zero(factor_.size());
  rhs.head(n_) = x;
  return solve(rhs).head(n_);
}

}  // namespace nurbeam
