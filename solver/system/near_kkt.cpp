#include "solver/system/near_kkt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace nurbeam {

NearKkt::NearKkt(const SecondOrderSystem& system, const std::vector<int>& around, int reach)
    : system_(system),
      pattern_(system.tangent_pattern()),
      n_(system.coordinate_count()),
      reach_(reach),
      fronts_(pattern_, CouplingLevels(pattern_, n_, around, reach + 3)),
      inner_(std::min(levels(), reach + 1)),
      rows_(std::min(levels(), reach + 2)),
      blocks_(fronts_.block_size()),
      factors_(blocks_.size()),
      row_sizes_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(fronts_.unknowns().size()))) {
  list_entries();
}

void NearKkt::list_entries() {
  const int *starts = pattern_.column_starts().data(), *rows = pattern_.rows().data();
  const std::vector<int>& unknowns = fronts_.unknowns();
  std::vector<int> place(static_cast<std::size_t>(pattern_.size()), -1);
  for (int k = 0; k < static_cast<int>(unknowns.size()); ++k) place[unknowns[k]] = k;
  columns_.reserve(unknowns.size());
  for (const Front& front : fronts_.all())
    for (int k = front.first; k < front.first + front.own; ++k) {
      const int column = unknowns[k];
      if (k > front.first && column == unknowns[k - 1] + 1 && coupled_alike(pattern_, column - 1, column)) {
        ++columns_.back().count;
        continue;
      }
      const int begin = starts[column], end = starts[column + 1];
      columns_.push_back({column, 1, k, static_cast<int>(entries_.size()), end - begin});
      for (int e = begin; e < end; ++e)
        entries_.push_back(place[rows[e]] >= 0 ? fronts_.index(place[rows[e]], k) : -1);
    }
}

std::vector<int> NearKkt::unknowns() const {
  std::vector<int> inner(fronts_.unknowns().begin(), fronts_.unknowns().begin() + start(inner_));
  std::sort(inner.begin(), inner.end());
  return inner;
}

std::vector<bool> NearKkt::rows() const {
  std::vector<bool> known(static_cast<std::size_t>(pattern_.size()), false);
  for (int k = 0; k < start(rows_); ++k) known[fronts_.unknowns()[k]] = true;
  return known;
}

bool NearKkt::factorise(const State& state, double h) {
  const int renewed = renewed_levels(state);
  if (renewed == 0) return true;
  read(state, h, renewed);
  q_.resize(0);
  for (int level = std::min(renewed, inner_) - 1; level >= 0; --level)
    if (!eliminate(level)) return false;
  q_ = state.q;
  return true;
}

// Number of levels, from the first on, whose rows differ from the present matrix: a coordinate changes the
// rows of unknowns coupled with it.
int NearKkt::renewed_levels(const State& state) const {
  if (q_.size() == 0) return rows_;
  for (int level = levels() - 1; level >= 0; --level)
    for (int k = start(level); k < start(level + 1); ++k)
      if (const int i = fronts_.unknowns()[k]; i < n_ && state.q[i] != q_[i])
        return std::min(level + 2, rows_);
  return 0;
}

// Reads the rows of the first levels.
void NearKkt::read(const State& state, double h, int levels) {
  const int *starts = pattern_.column_starts().data(), columns = start(std::min(levels + 1, this->levels()));
  // Columns of other unknowns are never read, and stay unset.
  const auto values = std::make_unique_for_overwrite<double[]>(pattern_.rows().size());
  std::vector<bool> near(static_cast<std::size_t>(pattern_.size()), false);
  for (int k = 0; k < columns; ++k) {
    const int unknown = fronts_.unknowns()[k];
    std::fill(values.get() + starts[unknown], values.get() + starts[unknown + 1], 0.0);
    if (k < start(levels)) near[unknown] = true;
  }
  system_.tangent_near(state, {.mass = 1, .damping = h / 2, .stiffness = h * h / 4}, near, values.get());
  take(values.get(), levels);
}

// Takes new entries in the rows and the columns of the first levels; for a new matrix also in the columns of
// the next level.
void NearKkt::take(const double* values, int levels) {
  const bool all = q_.size() == 0;
  const int columns_end = start(all ? std::min(levels + 1, this->levels()) : levels);
  const int blocks_end = all ? fronts_.block_size() : fronts_.of_level(levels - 1).back().end();
  if (all) blocks_.setZero();
  for (const Columns& columns : columns_) {
    if (columns.place >= columns_end) break;
    for (int c = 0; c < columns.count; ++c) {
      const double* const of_column = values + pattern_.column_starts()[columns.first + c];
      for (int e = 0; e < columns.rows; ++e)
        if (const int entry = entries_[columns.entries + e]; entry >= 0 && entry < blocks_end)
          blocks_[entry + c] = of_column[e];
      if (columns.first + c < n_) continue;
      const Eigen::Map<const Eigen::ArrayXd> entries(of_column, columns.rows);
      row_sizes_[columns.place + c] = entries.abs().maxCoeff();
    }
  }
}

// Eliminates a level's unknowns in their fronts; levels behind must have been eliminated. False where a pivot
// is zero or not finite.
bool NearKkt::eliminate(int level) {
  const std::span<const Front> fronts = fronts_.of_level(level), all = fronts_.all();
  const int begin = fronts.front().blocks, size = fronts.back().end() - begin;
  factors_.segment(begin, size) = blocks_.segment(begin, size);
  if (level + 1 < inner_)
    for (const Front& front : fronts_.of_level(level + 1))
      if (front.parent >= 0) take_from_parent(front, all[front.parent], factors_.data());
  return std::all_of(fronts.begin(), fronts.end(),
                     [&](const Front& front) { return nurbeam::factorise(front, factors_.data()); });
}

// Solves in place: x has the rows of the unknowns that are solved for, and then these unknowns.
void NearKkt::solve(Eigen::VectorXd& x) const {
  for (int level = inner_ - 1; level >= 0; --level)
    for (const Front& front : fronts_.of_level(level)) solve_inwards(front, factors_.data(), x.data());
  for (int level = 0; level < inner_; ++level)
    for (const Front& front : fronts_.of_level(level)) solve_outwards(front, factors_.data(), x.data());
}

// The residual right - A left in the first rows.
Eigen::VectorXd NearKkt::open_rows(const Eigen::VectorXd& right, const Eigen::VectorXd& left) const {
  Eigen::VectorXd open = Eigen::VectorXd::Zero(left.size());
  open.head(right.size()) = right;
  for (const Front& front : fronts_.all()) subtract_product(front, blocks_.data(), left.data(), open.data());
  return open.head(right.size());
}

// Round-off of the residual. Rows of coordinates are compared with the largest such row, rows of constraints
// with the largest coordinate that they hold. Rows beyond the unknowns that are solved for may be as open as
// steps leave them.
Eigen::VectorXd NearKkt::round_off(const Eigen::VectorXd& right, const Eigen::VectorXd& left) const {
  constexpr double epsilon = std::numeric_limits<double>::epsilon(), beyond = 2000;
  const int count = static_cast<int>(right.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(left.size());
  sum.head(count) = right.cwiseAbs();
  for (const Front& front : fronts_.all())
    add_absolute_product(front, blocks_.data(), left.data(), sum.data());
  sum.conservativeResize(count);
  const double largest_row = largest_coordinate(sum), largest_unknown = largest_coordinate(left);
  for (int k = 0; k < count; ++k) {
    const double largest = is_coordinate(k) ? largest_row : row_sizes_[k] * largest_unknown;
    sum[k] = epsilon * std::max(32 * sum[k], (k < start(inner_) ? 4 : beyond) * largest);
  }
  return sum;
}

// The largest entry at the first places that is a coordinate's.
double NearKkt::largest_coordinate(const Eigen::VectorXd& of) const {
  double largest = 0;
  for (int k = 0; k < static_cast<int>(of.size()); ++k)
    if (is_coordinate(k)) largest = std::max(largest, std::abs(of[k]));
  return largest;
}

bool NearKkt::correct(const Eigen::VectorXd& top, const Eigen::VectorXd& bottom, Eigen::VectorXd& x,
                      Eigen::VectorXd& y) const {
  const Eigen::VectorXd right = near_part(top, bottom).head(start(rows_));
  Eigen::VectorXd left = near_part(x, y);
  if (!correct(right, round_off(right, left), left)) return false;
  put_back(left, x, y);
  return true;
}

bool NearKkt::answer(const Eigen::VectorXd& top, const Eigen::VectorXd& bottom, Eigen::VectorXd& x,
                     Eigen::VectorXd& y) const {
  const int beyond = start(rows_) - start(inner_);
  Eigen::VectorXd left = near_part(x, y), open = near_part(top, bottom).head(start(rows_));
  open.tail(beyond).setZero();
  const Eigen::VectorXd present = -open_rows(Eigen::VectorXd::Zero(open.size()), left),
                        right = open + present;
  Eigen::VectorXd correction = open.head(start(inner_));
  solve(correction);
  if (!correction.allFinite()) return false;
  left.head(correction.size()) += correction;
  Eigen::ArrayXd enough = round_off(right, left);
  enough.tail(beyond) = faded(open, present, correction).tail(beyond);
  if (!correct(right, enough, left)) return false;
  put_back(left, x, y);
  return true;
}

// Limits of rows that have faded. In rows of coordinates the limit is a small part of the open rows, or a
// slight part of the closed forces there. Both are divided by the root of the diagonal entries, so that
// forces and moments compare. In rows of constraints it is a small part of the correction.
Eigen::ArrayXd NearKkt::faded(const Eigen::VectorXd& open, const Eigen::VectorXd& present,
                              const Eigen::VectorXd& correction) const {
  constexpr double small = 1e-4, slight = 1e-6;
  const double largest = largest_coordinate(correction);
  Eigen::ArrayXd rows = row_sizes_.head(open.size()).array() * largest;
  double of_open = 0;
  for (int k = 0; k < open.size(); ++k) {
    if (!is_coordinate(k)) continue;
    rows[k] = std::sqrt(std::abs(blocks_[fronts_.index(k, k)]));
    if (rows[k] > 0)
      of_open =
          std::max({of_open, std::abs(open[k]) / rows[k], slight / small * std::abs(present[k]) / rows[k]});
  }
  for (int k = 0; k < open.size(); ++k)
    if (is_coordinate(k)) rows[k] *= of_open;
  return small * rows;
}

// Corrects until the first rows are closed to `enough`.
bool NearKkt::correct(const Eigen::VectorXd& right, const Eigen::ArrayXd& enough,
                      Eigen::VectorXd& left) const {
  constexpr int most_corrections = 3;
  Eigen::VectorXd open = open_rows(right, left);
  for (int corrections = 0; !(open.array().abs() <= enough).all(); ++corrections) {
    if (corrections == most_corrections) return false;
    Eigen::VectorXd correction = open.head(start(inner_));
    solve(correction);
    if (!correction.allFinite()) return false;
    left.head(correction.size()) += correction;
    open = open_rows(right, left);
  }
  return true;
}

// The entries of coordinates and multipliers, by place.
Eigen::VectorXd NearKkt::near_part(const Eigen::VectorXd& top, const Eigen::VectorXd& bottom) const {
  const std::vector<int>& unknowns = fronts_.unknowns();
  Eigen::VectorXd part(static_cast<Eigen::Index>(unknowns.size()));
  for (Eigen::Index k = 0; k < part.size(); ++k)
    part[k] = unknowns[k] < n_ ? top[unknowns[k]] : bottom[unknowns[k] - n_];
  return part;
}

// Writes the unknowns that were solved for back into top and bottom.
void NearKkt::put_back(const Eigen::VectorXd& part, Eigen::VectorXd& top, Eigen::VectorXd& bottom) const {
  for (int k = 0; k < start(inner_); ++k) {
    const int i = fronts_.unknowns()[k];
    (i < n_ ? top[i] : bottom[i - n_]) = part[k];
  }
}

}  // namespace nurbeam
