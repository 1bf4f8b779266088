#include "solver/algebra/strand.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace nurbeam {

namespace {

/// Widest band that is eliminated as one: chains of elements, rings and a few branches have less.
constexpr int widest_band = 40;

// The order in blocks; unchanged where the band would be wide, with unknowns as they are numbered.
BandOrder in_best_order(BandOrder order) {
  if (order.half_bandwidth <= widest_band) {
    BandOrder aligned = order.aligned(BandedLu::block);
    return aligned.half_bandwidth <= widest_band ? aligned : order;
  }
  std::sort(order.unknown.begin(), order.unknown.end());
  for (std::size_t k = 0; k < order.unknown.size(); ++k) order.place[order.unknown[k]] = static_cast<int>(k);
  return order;
}

}  // namespace

StrandOrder::StrandOrder(const SparseView& matrix, BandOrder of, const std::vector<int>& in_part)
    : band(std::make_shared<const BandOrder>(in_best_order(std::move(of)))) {
  const auto for_each_row = [&](int column, const auto& visit) {
    for (int k = matrix.outerIndexPtr()[column]; k < matrix.outerIndexPtr()[column + 1]; ++k)
      visit(matrix.innerIndexPtr()[k], k);
  };
  bool apart = false;  // the column before is not coupled with the part
  for (int column = 0; column < matrix.cols(); ++column) {
    const int place = band->place[column], part = in_part[column];
    if (part < 0 && apart && have_same_rows(matrix, column - 1, column)) continue;
    apart = false;
    if (part >= 0)
      for_each_row(column, [&](int row, int value) {
        if (band->place[row] >= 0) into.push_back({value, band->place[row], part});
      });
    else if (place >= 0) {
      const std::size_t before = out_of.size();
      for_each_row(column, [&](int row, int value) {
        if (in_part[row] >= 0) out_of.push_back({value, place, in_part[row]});
      });
      apart = out_of.size() == before;
    }
  }
  const auto by_part = [](const Entry& a, const Entry& b) {
    return a.part != b.part ? a.part < b.part : a.place < b.place;
  };
  std::sort(into.begin(), into.end(), by_part);
  std::sort(out_of.begin(), out_of.end(), by_part);
}

Strand::Strand(std::shared_ptr<const StrandOrder> order, const SparseView& matrix)
    : order_(std::move(order)) {
  is_banded_ = band().half_bandwidth <= widest_band;
  if (is_banded_) {
    lu_.take(order_->band);
    y_ = lu_.places();
    return;
  }
  y_.assign(band().unknown.size(), 0);
  sparse_lu_ = std::make_unique<SparseLu<double>>();
  extract(matrix);
  is_structurally_regular_ = sparse_lu_->analyse(matrix_);
}

Strand::~Strand() = default;
Strand::Strand(Strand&&) noexcept = default;

// Extracts A from the whole matrix.
void Strand::extract(const SparseView& matrix) {
  matrix_.resize(size(), size());
  matrix_.reserve(matrix.nonZeros());
  for (int k = 0; k < size(); ++k) {
    matrix_.startVec(k);
    for (Eigen::InnerIterator<SparseView> entry(matrix, band().unknown[k]); entry; ++entry)
      if (band().place[entry.row()] >= 0) matrix_.insertBack(band().place[entry.row()], k) = entry.value();
  }
  matrix_.finalize();
}

// Factorises A; returns the reciprocal condition.
double Strand::factors(const SparseView& matrix) {
  if (is_banded_) return lu_.factorise(matrix);
  if (!is_structurally_regular_) return 0;
  extract(matrix);
  return sparse_lu_->factorise(matrix_);
}

void Strand::solve_whole(BandedLu::Places& y) const {
  Eigen::Map<Eigen::VectorXd>(y.data(), size()) =
      sparse_lu_->solve(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(y.data(), size())));
}

bool Strand::factorise(const SparseView& matrix, std::size_t part) {
  if (!(factors(matrix) > smallest_reciprocal_condition)) return false;
  const double* values = matrix.valuePtr();
  into_.resize(part);
  out_of_.resize(part);
  std::fill(y_.begin(), y_.end(), 0);
  // Puts the entries of one unknown of the part into y, times scale(place). Returns the last place, -1
  // without entries.
  const auto load = [&](auto& entry, const auto end, std::size_t j, int& first, const auto& scale) {
    int last = -1;
    for (; entry != end && entry->part == static_cast<int>(j); ++entry) {
      if (last < 0) first = entry->place;
      last = entry->place;
      y_[entry->place] = scale(entry->place) * values[entry->value];
    }
    return last;
  };
  auto b = order_->into.begin(), c = order_->out_of.begin();
  const int end = static_cast<int>(size()) - 1;
  for (std::size_t j = 0; j < part; ++j) {
    int first = 0, last = load(b, order_->into.end(), j, first,
                               [&](int place) { return is_banded_ ? lu_.scale(place) : 1.0; });
    if (last >= 0 && is_banded_) {
      lu_.lower(y_, first, last);
      first = std::max(0, first - band().half_bandwidth);
    } else if (last >= 0) {
      solve_whole(y_);
      first = 0;
      last = end;
    }
    keep(into_[j], first, last);
    first = 0;
    last = load(c, order_->out_of.end(), j, first, [](int) { return 1.0; });
    if (last >= 0 && is_banded_) lu_.upper_transposed(y_, first, last);
    keep(out_of_[j], first, last);
  }
  return true;
}

// Moves the numbers in y into a piece, and clears y.
void Strand::keep(Piece& piece, int first, int last) {
  piece.first = first;
  piece.values.assign(y_.begin() + first, y_.begin() + last + 1);
  std::fill(y_.begin() + first, y_.begin() + last + 1, 0);
}

double Strand::product(const Piece& a, const Piece& b) {
  const int first = std::max(a.first, b.first), last = std::min(a.first + static_cast<int>(a.values.size()),
                                                                b.first + static_cast<int>(b.values.size()));
  if (first >= last) return 0;
  return std::inner_product(a.values.begin() + (first - a.first), a.values.begin() + (last - a.first),
                            b.values.begin() + (first - b.first), 0.0);
}

void Strand::take_from(Eigen::MatrixXd& schur) const {
  for (std::size_t i = 0; i < out_of_.size(); ++i)
    for (std::size_t j = 0; j < into_.size(); ++j)
      schur(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) -= product(out_of_[i], into_[j]);
}

void Strand::lower(const Eigen::VectorXd& rhs) {
  if (is_banded_) {
    lu_.load(rhs, y_);
    lu_.lower(y_);
    return;
  }
  for (std::size_t k = 0; k < y_.size(); ++k) y_[k] = rhs[band().unknown[k]];
  solve_whole(y_);
}

double Strand::beside(std::size_t part) const {
  const Piece& piece = out_of_[part];
  return std::inner_product(piece.values.begin(), piece.values.end(), y_.begin() + piece.first, 0.0);
}

void Strand::upper(const Eigen::VectorXd& part, Eigen::VectorXd& x) {
  for (Eigen::Index j = 0; j < part.size(); ++j) {
    const Piece& piece = into_[j];
    for (std::size_t k = 0; k < piece.values.size(); ++k) y_[piece.first + k] -= part[j] * piece.values[k];
  }
  if (is_banded_) lu_.upper(y_);
  for (std::size_t k = 0; k < band().unknown.size(); ++k)
    if (const int unknown = band().unknown[k]; unknown >= 0) x[unknown] = y_[k];
}

}  // namespace nurbeam
