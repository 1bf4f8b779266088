#include "solver/updated_kkt.h"

namespace nurbeam {

bool UpdatedKkt::factorise(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& unknowns) {
  unknowns_ = unknowns;
  has_columns_ = is_changed_ = false;
  return solver_.factorise(matrix);
}

bool UpdatedKkt::update(const Eigen::MatrixXd& change) {
  const auto p = static_cast<Eigen::Index>(unknowns_.size());
  if (!has_columns_) solver_.solve_units(unknowns_, columns_);
  has_columns_ = true;
  change_ = change;
  core_.setIdentity(p, p);
  for (Eigen::Index j = 0; j < p; ++j)
    for (Eigen::Index k = 0; k < p; ++k) core_.col(j) += columns_(unknowns_[k], j) * change_.col(k);
  is_changed_ = core_.allFinite();
  if (is_changed_) inner_.compute(core_);
  return is_changed_;
}

void UpdatedKkt::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const {
  solver_.solve(rhs, x);
  if (!is_changed_) return;
  at_part_.resize(change_.cols());
  for (Eigen::Index k = 0; k < at_part_.size(); ++k) at_part_[k] = x[unknowns_[static_cast<std::size_t>(k)]];
  taken_.noalias() = change_ * at_part_;
  at_part_ = inner_.solve(taken_);
  x.noalias() -= columns_ * at_part_;
}

}  // namespace nurbeam
