#include "solver/kkt_solver.h"

#include <Eigen/KLUSupport>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <memory>
#include <numeric>
#include <vector>

#include "solver/banded_lu.h"
#include "solver/finite.h"

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

// Of all unknowns but the last ones: as they come, where a band would be wide.
std::shared_ptr<const BandOrder> order_of(const Matrix& matrix, const std::vector<int>& last) {
  auto order = std::make_shared<BandOrder>(matrix, last);
  if (order->half_bandwidth <= widest_band) return order;
  std::sort(order->unknown.begin(), order->unknown.end());
  for (std::size_t k = 0; k < order->unknown.size(); ++k)
    order->place[order->unknown[k]] = static_cast<int>(k);
  return order;
}

// The indices of a matrix, the part that is eliminated last, the order of the other unknowns, and which
// entries are where.
struct AnalysedPattern {
  std::vector<int> column_starts, row_indices, part;
  std::shared_ptr<const BandOrder> order;

  // Entries of B (row of A, column of S), of C (column of A, row of S), of S (row, column, both of S).
  struct Entry {
    int value, place, part;  // among the matrix's values; the other two as said
  };
  std::vector<Entry> into, out_of, within;

  AnalysedPattern(const Matrix& matrix, const std::vector<int>& last)
      : column_starts(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1),
        row_indices(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros()),
        part(last),
        order(order_of(matrix, last)) {
    if (part.empty()) return;
    std::vector<int> in_part(static_cast<std::size_t>(matrix.cols()), -1);
    for (std::size_t j = 0; j < part.size(); ++j) in_part[part[j]] = static_cast<int>(j);
    for (int column = 0; column < matrix.cols(); ++column)
      for (int k = column_starts[column]; k < column_starts[column + 1]; ++k) {
        const int row = row_indices[k];
        if (in_part[row] >= 0 && in_part[column] >= 0)
          within.push_back({k, in_part[row], in_part[column]});
        else if (in_part[column] >= 0)
          into.push_back({k, order->place[row], in_part[column]});
        else if (in_part[row] >= 0)
          out_of.push_back({k, order->place[column], in_part[row]});
      }
    const auto by_part = [](const Entry& a, const Entry& b) {
      return a.part != b.part ? a.part < b.part : a.place < b.place;
    };
    std::sort(into.begin(), into.end(), by_part);
    std::sort(out_of.begin(), out_of.end(), by_part);
  }

  bool is_of(const Matrix& matrix, const std::vector<int>& last) const {
    const auto columns = static_cast<std::size_t>(matrix.cols());
    const auto entries = static_cast<std::size_t>(matrix.nonZeros());
    return column_starts.size() == columns + 1 && row_indices.size() == entries && part == last &&
           std::equal(column_starts.begin(), column_starts.end(), matrix.outerIndexPtr()) &&
           std::equal(row_indices.begin(), row_indices.end(), matrix.innerIndexPtr());
  }
};

// A, factorised within its band or by KLU, whose L is then A, and U is 1.
class Inner {
 public:
  using Places = BandedLu::Places;

  // Makes room for it. `matrix`: of the pattern.
  void take(std::shared_ptr<const BandOrder> order, const Matrix& matrix) {
    order_ = std::move(order);
    is_banded_ = order_->half_bandwidth <= widest_band;
    if (is_banded_) {
      band_.take(order_);
    } else {
      extract(matrix);
      klu_.analyzePattern(matrix_);
      is_structurally_regular_ = klu_.info() == Eigen::Success;
    }
  }

  Places places() const { return is_banded_ ? band_.places() : Places(order_->unknown.size(), 0); }

  // The reciprocal condition.
  double factorise(const Matrix& matrix) {
    if (is_banded_) return band_.factorise(matrix);
    if (!is_structurally_regular_) return 0;
    extract(matrix);
    klu_.factorize(matrix_);
    return klu_.info() == Eigen::Success ? klu_.reciprocal_condition() : 0;
  }

  // The band, where there is one.
  const BandedLu* band() const { return is_banded_ ? &band_ : nullptr; }
  double scale(int place) const { return is_banded_ ? band_.scale(place) : 1; }
  void load(const Eigen::VectorXd& rhs, Places& y) const {
    if (is_banded_)
      band_.load(rhs, y);
    else
      for (std::size_t k = 0; k < y.size(); ++k) y[k] = rhs[order_->unknown[k]];
  }
  void lower(Places& y) const {
    if (is_banded_)
      band_.lower(y);
    else
      Eigen::Map<Eigen::VectorXd>(y.data(), size()) =
          klu_.solve(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(y.data(), size())));
  }
  void lower(Places& y, int& first, int& last) const {
    if (is_banded_) {
      band_.lower(y, first, last);
      first = std::max(0, first - order_->half_bandwidth);
    } else {
      lower(y);
      first = 0;
      last = static_cast<int>(size()) - 1;
    }
  }
  void upper(Places& y) const {
    if (is_banded_) band_.upper(y);
  }
  void upper_transposed(Places& y, int first, int& last) const {
    if (is_banded_) band_.upper_transposed(y, first, last);
  }
  void store(const Places& y, Eigen::VectorXd& x) const {
    for (std::size_t k = 0; k < order_->unknown.size(); ++k) x[order_->unknown[k]] = y[k];
  }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(order_->unknown.size()); }

  // A of all rows and columns.
  void extract(const Matrix& matrix) {
    matrix_.resize(size(), size());
    matrix_.reserve(matrix.nonZeros());
    for (int k = 0; k < size(); ++k) {
      matrix_.startVec(k);
      for (Matrix::InnerIterator entry(matrix, order_->unknown[k]); entry; ++entry)
        if (order_->place[entry.row()] >= 0)
          matrix_.insertBack(order_->place[entry.row()], k) = entry.value();
    }
    matrix_.finalize();
  }

  std::shared_ptr<const BandOrder> order_;
  bool is_banded_ = false, is_structurally_regular_ = false;
  BandedLu band_;
  Klu klu_;
  Matrix matrix_;  // that KLU takes
};

// A row of W or a column of V: zero but from `first` on.
struct Piece {
  int first = 0;
  std::vector<double> values;

  void take(const BandedLu::Places& y, int from, int last) {
    first = from;
    values.assign(y.begin() + from, y.begin() + last + 1);
  }
};

}  // namespace

struct KktSolver::Implementation {
  std::shared_ptr<const AnalysedPattern> pattern;
  Inner inner;
  std::vector<Piece> into, out_of;  // V by columns, W by rows
  Eigen::MatrixXd schur;            // S - W V as factorised
  Eigen::MatrixXd corner;           // the same with what has changed, row-scaled
  Eigen::VectorXd corner_scale;
  Eigen::PartialPivLU<Eigen::MatrixXd> corner_lu;
  mutable BandedLu::Places y;
  mutable Eigen::VectorXd rest, part;

  void analyse(const Matrix& matrix, const std::vector<int>& last) {
    // Of one mesh several matrices are solved, by as many solvers: the order that was found last is at hand.
    thread_local std::shared_ptr<const AnalysedPattern> found;
    if (!found || !found->is_of(matrix, last)) found = std::make_shared<AnalysedPattern>(matrix, last);
    pattern = found;
    inner.take(pattern->order, matrix);
    y = inner.places();
  }

  // V, W and the Schur complement of A.
  void eliminate_part(const Matrix& matrix) {
    const std::size_t p = pattern->part.size();
    const double* values = matrix.valuePtr();
    into.resize(p);
    out_of.resize(p);
    schur.setZero(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(p));
    for (const auto& [value, row, column] : pattern->within) schur(row, column) += values[value];
    std::fill(y.begin(), y.end(), 0);
    auto b = pattern->into.begin(), c = pattern->out_of.begin();
    for (std::size_t j = 0; j < p; ++j) {
      int first = 0, last = -1;
      for (; b != pattern->into.end() && b->part == static_cast<int>(j); ++b) {
        if (last < 0) first = b->place;
        last = b->place;
        y[b->place] = inner.scale(b->place) * values[b->value];
      }
      if (last >= 0) inner.lower(y, first, last);
      keep(into[j], first, last);
      first = 0, last = -1;
      for (; c != pattern->out_of.end() && c->part == static_cast<int>(j); ++c) {
        if (last < 0) first = c->place;
        last = c->place;
        y[c->place] = values[c->value];
      }
      if (last >= 0) inner.upper_transposed(y, first, last);
      keep(out_of[j], first, last);
    }
    for (std::size_t i = 0; i < p; ++i)
      for (std::size_t j = 0; j < p; ++j)
        schur(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) -= product(out_of[i], into[j]);
  }

  void keep(Piece& piece, int first, int last) const {
    piece.take(y, first, last);
    std::fill(y.begin() + first, y.begin() + last + 1, 0);
  }

  static double product(const Piece& a, const Piece& b) {
    const int first = std::max(a.first, b.first),
              last = std::min(a.first + static_cast<int>(a.values.size()),
                              b.first + static_cast<int>(b.values.size()));
    if (first >= last) return 0;
    return std::inner_product(a.values.begin() + (first - a.first), a.values.begin() + (last - a.first),
                              b.values.begin() + (first - b.first), 0.0);
  }

  // The factors of the corner, its rows scaled; whether it is regular.
  bool factorise_corner() {
    if (!corner.allFinite()) return false;
    corner_scale = corner.rowwise().lpNorm<Eigen::Infinity>();
    if (!(corner_scale.minCoeff() > 0)) return false;
    corner_scale = corner_scale.cwiseInverse();
    corner.array().colwise() *= corner_scale.array();
    corner_lu.compute(corner);
    const auto pivots = corner_lu.matrixLU().diagonal().cwiseAbs();
    return pivots.minCoeff() > smallest_reciprocal_condition * pivots.maxCoeff();
  }

  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const {
    inner.load(rhs, y);
    inner.lower(y);
    x.resize(rhs.size());
    if (!pattern->part.empty()) solve_part(rhs, x);
    inner.upper(y);
    inner.store(y, x);
  }

  // What y lacks of U x of the other unknowns, after that part of x.
  void solve_part(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const {
    const auto p = static_cast<Eigen::Index>(pattern->part.size());
    rest.resize(p);
    for (Eigen::Index j = 0; j < p; ++j) {
      const Piece& piece = out_of[j];
      rest[j] = corner_scale[j] *
                (rhs[pattern->part[j]] -
                 std::inner_product(piece.values.begin(), piece.values.end(), y.begin() + piece.first, 0.0));
    }
    part = corner_lu.solve(rest);
    for (Eigen::Index j = 0; j < p; ++j) {
      x[pattern->part[j]] = part[j];
      const Piece& piece = into[j];
      for (std::size_t k = 0; k < piece.values.size(); ++k) y[piece.first + k] -= part[j] * piece.values[k];
    }
  }
};

KktSolver::KktSolver() : implementation_(std::make_unique<Implementation>()) {}
KktSolver::~KktSolver() = default;
KktSolver::KktSolver(KktSolver&&) noexcept = default;
KktSolver& KktSolver::operator=(KktSolver&&) noexcept = default;

bool KktSolver::factorise(const Matrix& matrix, const std::vector<int>& part) {
  assert(matrix.isCompressed() && matrix.rows() == matrix.cols());
  Implementation& self = *implementation_;
  if (!self.pattern || !self.pattern->is_of(matrix, part)) self.analyse(matrix, part);
  if (!all_finite(Eigen::Map<const Eigen::ArrayXd>(matrix.valuePtr(), matrix.nonZeros())) ||
      !(self.inner.factorise(matrix) > smallest_reciprocal_condition))
    return false;
  if (part.empty()) return true;
  self.eliminate_part(matrix);
  self.corner = self.schur;
  return self.factorise_corner();
}

bool KktSolver::renew(const Eigen::MatrixXd& change) {
  implementation_->corner = implementation_->schur + change;
  return implementation_->factorise_corner();
}

void KktSolver::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const {
  implementation_->solve(rhs, x);
}

void KktSolver::solve(const Columns& rhs, Columns& x) const {
  const Implementation& self = *implementation_;
  if (const BandedLu* band = self.inner.band(); band && self.pattern->part.empty())
    return band->solve(rhs, x);
  x.resize(rhs.rows(), rhs.cols());
  Eigen::VectorXd of_one;
  for (Eigen::Index column = 0; column < rhs.cols(); ++column) {
    self.solve(rhs.col(column), of_one);
    x.col(column) = of_one;
  }
}

Eigen::VectorXd KktSolver::solve(const Eigen::VectorXd& rhs) const {
  Eigen::VectorXd x;
  solve(rhs, x);
  return x;
}

}  // namespace nurbeam
