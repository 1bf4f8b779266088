#include "solver/algebra/equilibrated_kkt.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

// Excess of the factors of columns. One column of a constraint may outweigh all others by a large ratio. Its
// entries in B are then negligible beside theirs, and are round-off, as of the curvature of a straight guide.
// The factor is then too large by this ratio. Columns that are round-off of the constraint itself do not
// count.
Vector excess_of_columns(const Matrix& kkt, int n, const Vector& factor) {
  constexpr double nothing = 1e-13;    // part of a stiffness
  constexpr double round_off = 1e-14;  // part of a constraint
  struct Row {
    double first = 0, second = 0;
    int column = -1;  // column of the first one
  };
  std::vector<Row> rows(static_cast<std::size_t>(kkt.rows() - n));
  for (int column = 0; column < n; ++column)
    for (Matrix::InnerIterator entry(kkt, column); entry; ++entry) {
      if (entry.row() < n) continue;
      Row& row = rows[static_cast<std::size_t>(entry.row() - n)];
      const double weight = std::abs(entry.value()) * factor[column];
      if (weight > row.first)
        row = {weight, row.first, column};
      else
        row.second = std::max(row.second, weight);
    }
  Vector excess = Vector::Ones(n);
  for (const Row& row : rows)
    if (row.second > round_off * row.first && row.second < std::sqrt(nothing) * row.first)
      excess[row.column] = std::max(excess[row.column], row.first / row.second);
  return excess;
}

}  // namespace

Vector equilibration(const Matrix& kkt, int n) {
  Vector largest = Vector::Zero(kkt.cols());
  for (int column = 0; column < n; ++column)
    for (Matrix::InnerIterator entry(kkt, column); entry; ++entry)
      if (entry.row() < n) largest[column] = std::max(largest[column], std::abs(entry.value()));
  Vector factor = (largest.array() > 0).select(largest.cwiseSqrt().cwiseInverse(), 1.0);
  factor.head(n).array() /= excess_of_columns(kkt, n, factor).array();
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

EquilibratedKkt::EquilibratedKkt(const Matrix& kkt, int n) : factor_(equilibration(kkt, n)) {
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

}  // namespace nurbeam
