#include "solver/near_kkt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nurbeam {

CouplingLevels::CouplingLevels(const SparsePattern& pattern, int coordinates, const std::vector<int>& first,
                               int most)
    : unknowns(first), starts{0} {
  const int *columns = pattern.column_starts().data(), *rows = pattern.rows().data();
  std::vector<int> level_of(static_cast<std::size_t>(pattern.size()), -1);
  for (const int unknown : first) level_of[unknown] = 0;
  const auto each_coupled = [&](int unknown, const auto& visit) {
    for (int k = columns[unknown]; k < columns[unknown + 1]; ++k) visit(rows[k]);
  };
  // Of a constraint whose coordinates are all in the level before: its place is there.
  const auto comes_too_late = [&](int unknown) {
    if (unknown < coordinates) return false;
    bool alone = true;
    each_coupled(unknown, [&](int row) {
      alone = alone && (row >= coordinates || level_of[row] != level_of[unknown]);
    });
    return alone;
  };
  for (int level = 0, begin = 0; begin < static_cast<int>(unknowns.size()) && level < most; ++level) {
    const int end = static_cast<int>(unknowns.size());
    for (int k = begin; k < end; ++k)
      each_coupled(unknowns[k], [&](int row) {
        if (level_of[row] >= 0) return;
        level_of[row] = level + 1;
        unknowns.push_back(row);
      });
    const auto next = std::partition(unknowns.begin() + end, unknowns.end(), comes_too_late);
    std::for_each(unknowns.begin() + end, next, [&](int unknown) { level_of[unknown] = level; });
    std::sort(unknowns.begin() + begin, next);
    begin = static_cast<int>(next - unknowns.begin());
    starts.push_back(begin);
  }
  unknowns.resize(static_cast<std::size_t>(starts.back()));
}

NearKkt::NearKkt(const SecondOrderSystem& system, const std::vector<int>& around, int reach)
    : system_(system),
      pattern_(system.tangent_pattern()),
      n_(system.coordinate_count()),
      levels_(pattern_, n_, around, reach + 3),
      inner_(std::min(levels_.count(), reach + 1)),
      rows_(std::min(levels_.count(), reach + 2)),
      fronts_(static_cast<std::size_t>(inner_)) {
  const int *starts = pattern_.column_starts().data(), *rows = pattern_.rows().data();
  const int all = start(levels_.count());
  std::vector<int> place(static_cast<std::size_t>(pattern_.size()), all);
  for (int k = 0; k < all; ++k) place[levels_.unknowns[k]] = k;
  for (int k = 0; k < all; ++k) {
    const int column = levels_.unknowns[k];
    entries_.push_back({starts[column], static_cast<int>(row_places_.size())});
    for (int e = starts[column]; e < starts[column + 1]; ++e) row_places_.push_back(place[rows[e]]);
  }
  entries_.push_back({0, static_cast<int>(row_places_.size())});
}

std::vector<int> NearKkt::unknowns() const {
  std::vector<int> inner(levels_.unknowns.begin(), levels_.unknowns.begin() + start(inner_));
  std::sort(inner.begin(), inner.end());
  return inner;
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

// How many levels, from the first on, have other rows than in the matrix that is there: a coordinate changes
// those of what it is coupled with.
int NearKkt::renewed_levels(const State& state) const {
  if (q_.size() == 0) return rows_;
  for (int level = levels_.count() - 1; level >= 0; --level)
    for (int k = start(level); k < start(level + 1); ++k)
      if (const int i = levels_.unknowns[k]; i < n_ && state.q[i] != q_[i]) return std::min(level + 2, rows_);
  return 0;
}

// Takes the rows of the first levels.
void NearKkt::read(const State& state, double h, int levels) {
  // Nobody looks at the other columns.
  auto values = std::make_unique_for_overwrite<double[]>(pattern_.rows().size());
  for (int k = 0; k < start(std::min(levels + 1, levels_.count())); ++k)
    std::fill_n(values.get() + entries_[k].value, entries_[k + 1].row - entries_[k].row, 0.0);
  std::vector<bool> near(static_cast<std::size_t>(pattern_.size()), false);
  for (int k = 0; k < start(levels); ++k) near[levels_.unknowns[k]] = true;
  system_.tangent_near(state, {.mass = 1, .damping = h / 2, .stiffness = h * h / 4}, near, values.get());
  if (q_.size() == 0) {
    values_ = std::move(values);
    return;
  }
  // What has changed stands in both, the rows and the columns of these.
  for (int k = 0; k < start(levels); ++k)
    for_each_entry(k, [&](int place, int value) {
      if (place < start(levels)) values_[value] = values[value];
    });
}

// Takes a level's unknowns out of its front, which leaves there what the level before gets. False where one
// of its pivots is none.
bool NearKkt::eliminate(int level) {
  const int before = level > 0 ? size(level - 1) : 0, own = size(level), all = own + before;
  Front& front = fronts_[level];
  front.setZero(all, all);
  const int first = start(level), first_before = first - before;
  // Those of the level before come behind its own.
  for (int k = first_before; k < first; ++k)
    for_each_entry(k, [&](int place, int value) {
      if (const int row = place - first; row >= 0 && row < own)
        front.data()[row * all + own + k - first_before] = values_[value];
    });
  for (int k = first; k < first + own; ++k)
    for_each_entry(k, [&](int place, int value) {
      if (place < first_before || place >= first + own) return;
      const int row = place >= first ? place - first : own + place - first_before;
      front.data()[row * all + k - first] = values_[value];
    });
  if (level + 1 < inner_) front.topLeftCorner(own, own) += fronts_[level + 1].bottomRightCorner(own, own);
  for (int p = 0; p < own; ++p) {
    const double* const pivots = front.data() + p * all;
    if (!std::isfinite(pivots[p]) || pivots[p] == 0) return false;
    for (int i = p + 1; i < all; ++i) {
      double* const row = front.data() + i * all;
      if (row[p] == 0) continue;
      const double factor = row[p] /= pivots[p];
      for (int j = p + 1; j < all; ++j) row[j] -= factor * pivots[j];
    }
  }
  return true;
}

// Rows of the unknowns that are solved for in, these out.
void NearKkt::solve(Eigen::VectorXd& x) const {
  for (int level = inner_ - 1; level >= 0; --level) {
    const int own = size(level), first = start(level), before = first - (level > 0 ? size(level - 1) : 0);
    const Front& front = fronts_[level];
    for (int i = 1; i < own; ++i) x[first + i] -= front.row(i).head(i).dot(x.segment(first, i));
    for (int i = before; i < first; ++i)
      x[i] -= front.row(own + i - before).head(own).dot(x.segment(first, own));
  }
  for (int level = 0; level < inner_; ++level) {
    const int own = size(level), first = start(level), before = first - (level > 0 ? size(level - 1) : 0);
    const Front& front = fronts_[level];
    for (int i = own - 1; i >= 0; --i) {
      const int more = own - 1 - i;
      x[first + i] = (x[first + i] - front.row(i).segment(i + 1, more).dot(x.segment(first + i + 1, more)) -
                      front.row(i).tail(first - before).dot(x.segment(before, first - before))) /
                     front(i, i);
    }
  }
}

// What is left of right - A left in the first rows.
Eigen::VectorXd NearKkt::open_rows(const Eigen::VectorXd& right, const Eigen::VectorXd& left) const {
  Eigen::VectorXd open = Eigen::VectorXd::Zero(left.size() + 1);  // the last of all beyond
  open.head(right.size()) = right;
  double* const of = open.data();
  for (int k = 0; k < static_cast<int>(left.size()); ++k)
    for_each_entry(k, [&, x = left[k]](int place, int value) { of[place] -= values_[value] * x; });
  return open.head(right.size());
}

// What of these is round-off: in rows of coordinates of what moves anywhere, in those of constraints of the
// largest of what they hold.
Eigen::VectorXd NearKkt::round_off(const Eigen::VectorXd& right, const Eigen::VectorXd& left) const {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(left.size() + 1);
  sum.head(right.size()) = right.cwiseAbs();
  double *const of = sum.data(), largest_unknown = 0, largest_row = 0;
  for (int k = 0; k < static_cast<int>(left.size()); ++k) {
    const double x = std::abs(left[k]);
    for_each_entry(k, [&](int place, int value) { of[place] += std::abs(values_[value]) * x; });
    if (levels_.unknowns[k] < n_) largest_unknown = std::max(largest_unknown, x);
  }
  for (int k = 0; k < static_cast<int>(right.size()); ++k)
    if (levels_.unknowns[k] < n_) largest_row = std::max(largest_row, sum[k]);
  for (int k = 0; k < static_cast<int>(right.size()); ++k) {
    double largest = largest_row;
    if (levels_.unknowns[k] >= n_) {
      largest = 0;
      for_each_entry(k, [&](int, int value) { largest = std::max(largest, std::abs(values_[value])); });
      largest *= largest_unknown;
    }
    sum[k] = epsilon * std::max(32 * sum[k], 4 * largest);
  }
  return sum.head(right.size());
}

bool NearKkt::correct(const Eigen::VectorXd& top, const Eigen::VectorXd& bottom, Beyond beyond,
                      Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  constexpr int most_corrections = 3;
  const int inner = start(inner_), count = start(beyond == Beyond::closed ? rows_ : inner_);
  const auto all = static_cast<Eigen::Index>(levels_.unknowns.size());
  Eigen::VectorXd right(count), left(all);
  for (int k = 0; k < all; ++k) {
    const int i = levels_.unknowns[k];
    left[k] = i < n_ ? x[i] : y[i - n_];
    if (k < count) right[k] = i < n_ ? top[i] : bottom[i - n_];
  }
  Eigen::VectorXd open = open_rows(right, left);
  const Eigen::ArrayXd enough = round_off(right, left);
  for (int corrections = 0; !(open.array().abs() <= enough).all(); ++corrections) {
    if (corrections == most_corrections) return false;
    Eigen::VectorXd correction = open.head(inner);
    solve(correction);
    if (!correction.allFinite()) return false;
    left.head(inner) += correction;
    open = open_rows(right, left);
  }
  for (int k = 0; k < inner; ++k) {
    const int i = levels_.unknowns[k];
    (i < n_ ? x[i] : y[i - n_]) = left[k];
  }
  return true;
}

}  // namespace nurbeam
