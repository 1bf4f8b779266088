#include "solver/kkt_solver.h"

#include <Eigen/KLUSupport>
#include <algorithm>
#include <cassert>
#include <memory>
#include <vector>

#include "solver/banded_lu.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// A few machine epsilons: what cancellation leaves of a pivot that is zero in exact arithmetic.
constexpr double smallest_reciprocal_condition = 1e-15;

/// Widest band that is eliminated as one: chains of elements, rings and a few branches have less.
constexpr int widest_band = 40;

/// KLU's own estimate of the reciprocal condition, smallest over largest pivot of the row-scaled factors.
class Klu : public Eigen::KLU<Matrix> {
 public:
  double reciprocal_condition() {
    klu_rcond(m_symbolic, m_numeric, &m_common);
    return m_common.rcond;
  }
};

bool all_finite(const Matrix& matrix) {
  return Eigen::Map<const Eigen::ArrayXd>(matrix.valuePtr(), matrix.nonZeros()).allFinite();
}

// The indices of a matrix and the order of its unknowns.
struct AnalysedPattern {
  std::vector<int> column_starts, row_indices;
  std::shared_ptr<const BandOrder> order;

  explicit AnalysedPattern(const Matrix& matrix)
      : column_starts(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1),
        row_indices(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros()),
        order(std::make_shared<BandOrder>(matrix)) {}

  bool is_of(const Matrix& matrix) const {
    const auto columns = static_cast<std::size_t>(matrix.cols());
    const auto entries = static_cast<std::size_t>(matrix.nonZeros());
    return column_starts.size() == columns + 1 && row_indices.size() == entries &&
           std::equal(column_starts.begin(), column_starts.end(), matrix.outerIndexPtr()) &&
           std::equal(row_indices.begin(), row_indices.end(), matrix.innerIndexPtr());
  }
};

}  // namespace

struct KktSolver::Implementation {
  Klu klu;
  BandedLu band;
  bool is_banded = false, structurally_regular = false;
  std::shared_ptr<const AnalysedPattern> pattern;

  void analyse(const Matrix& matrix) {
    // Of one mesh several matrices are solved, by as many solvers: the order that was found last is at hand.
    thread_local std::shared_ptr<const AnalysedPattern> last;
    if (!last || !last->is_of(matrix)) last = std::make_shared<AnalysedPattern>(matrix);
    pattern = last;
    is_banded = pattern->order->half_bandwidth <= widest_band;
    if (is_banded) {
      band.take(pattern->order);
      return;
    }
    klu.analyzePattern(matrix);
    structurally_regular = klu.info() == Eigen::Success;
  }
};

KktSolver::KktSolver() : implementation_(std::make_unique<Implementation>()) {}
KktSolver::~KktSolver() = default;
KktSolver::KktSolver(KktSolver&&) noexcept = default;
KktSolver& KktSolver::operator=(KktSolver&&) noexcept = default;

bool KktSolver::factorise(const Matrix& matrix) {
  assert(matrix.isCompressed() && matrix.rows() == matrix.cols());
  Implementation& self = *implementation_;
  if (!self.pattern || !self.pattern->is_of(matrix)) self.analyse(matrix);
  if (!all_finite(matrix)) return false;
  if (self.is_banded) return self.band.factorise(matrix) > smallest_reciprocal_condition;
  if (!self.structurally_regular) return false;
  self.klu.factorize(matrix);
  return self.klu.info() == Eigen::Success && self.klu.reciprocal_condition() > smallest_reciprocal_condition;
}

void KktSolver::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const {
  if (implementation_->is_banded)
    implementation_->band.solve(rhs, x);
  else
    x = implementation_->klu.solve(rhs);
}

void KktSolver::solve_units(const std::vector<int>& unknowns, Eigen::MatrixXd& columns) const {
  const auto p = static_cast<Eigen::Index>(unknowns.size());
  if (implementation_->is_banded) {
    implementation_->band.solve_units(unknowns, columns);
    return;
  }
  columns.setZero(implementation_->klu.rows(), p);
  for (Eigen::Index j = 0; j < p; ++j) columns(unknowns[static_cast<std::size_t>(j)], j) = 1;
  columns = implementation_->klu.solve(columns);
}

Eigen::VectorXd KktSolver::solve(const Eigen::VectorXd& rhs) const {
  Eigen::VectorXd x;
  solve(rhs, x);
  return x;
}

}  // namespace nurbeam
