#include <algorithm>
#include <memory>
#include <utility>

#include "solver/banded_lu_parts.h"

namespace nurbeam {

using namespace fours;

namespace {

// The sum of the four.
NURBEAM_WITHIN double sum_of(const Four& a) { return (a[0] + a[2]) + (a[1] + a[3]); }

}  // namespace

// Takes a block of unknowns whose rows stay out of the right-hand sides below it, from the `first` one on.
NURBEAM_WITHIN void BandedLu::take_out(int k, const Four& x, int first, double* y) const {
  const std::array<const double*, block> m = multipliers_below(k);
  for (int i = first; k + block + i <= blocks_[k / block].reach; i += block)
    four(y + block + i) -=
        four(m[0] + i) * x[0] + four(m[1] + i) * x[1] + four(m[2] + i) * x[2] + four(m[3] + i) * x[3];
}

// Finds a block of unknowns and takes it out of the right-hand sides below it.
NURBEAM_WITHIN void BandedLu::eliminate(int k, double* all) const {
  double* y = all + k;
  if (!blocks_[k / block].exchanged) {
    const Four x = product(blocks_[k / block].lower, four(y));
    four(y) = x;
    return take_out(k, x, 0, y);
  }
  const std::array<const double*, block> m = multipliers_below(k);
  const int last = blocks_[k / block].reach - k;
  for (int c = 0; c < block; ++c) {
    std::swap(y[c], all[pivots_[k + c]]);
    for (int i = c + 1; i < std::min(block, last + 1); ++i) y[i] -= multiplier(k + i, k + c) * y[c];
    for (int i = block; i <= last; ++i) y[i] -= m[c][i - block] * y[c];
  }
}

void BandedLu::load(const Eigen::VectorXd& rhs, Places& y) const {
  const std::size_t n = order_->unknown.size();
  for (std::size_t k = 0; k < n; ++k) {
    const int unknown = order_->unknown[k];
    y[k] = unknown < 0 ? 0 : scale_[k] * rhs[unknown];
  }
  std::fill(y.begin() + static_cast<std::ptrdiff_t>(n), y.end(), 0);
}

// Block by block, each taken out of those after it: of the next one when its turn comes.
NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::lower(Places& all) const {
  Four before = {};
  bool is_waiting = false;
  for (int k = 0; k < padded_; k += block) {
    double* y = all.data() + k;
    const Block& own = blocks_[k / block];
    if (own.exchanged) {
      if (is_waiting) {
        const std::array<const double*, block> m = multipliers_below(k - block);
        for (int c = 0; c < block; ++c) four(y) -= four(m[c]) * before[c];
      }
      eliminate(k, all.data());
    } else {
      Four x = product(own.lower, four(y));
      if (is_waiting) x -= product(own.from_previous, before);
      four(y) = before = x;
      take_out(k, x, block, y);
    }
    is_waiting = !own.exchanged;
  }
}

NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::lower(Places& y, int first, int& last) const {
  // An exchange brings a row up by no more than the band.
  for (int k = std::max(0, first - half_bandwidth_) / block * block; k <= last; k += block) {
    const auto is_zero = [&](int i) { return y[i] == 0 && y[pivots_[i]] == 0; };
    if (is_zero(k) && is_zero(k + 1) && is_zero(k + 2) && is_zero(k + 3)) continue;
    eliminate(k, y.data());
    last = std::max({last, blocks_[k / block].reach, *std::max_element(&pivots_[k], &pivots_[k] + block)});
  }
}

// Block by block from those after it, of which the next one comes in last: it is waited for.
NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::upper(Places& all) const {
  Four after = {};
  for (int k = padded_ - block; k >= 0; k -= block) {
    const Block& own = blocks_[k / block];
    const double* u = upper_.data() + own.upper_begin;
    double* y = all.data() + k;
    const int length = own.upper_length;
    Four sums[block] = {};
    for (int j = 2 * block; j < length; j += block)
      for (int r = 0; r < block; ++r) sums[r] += four(u + r * length + j) * four(y + j);
    const Four rest = four(y) - Four{sum_of(sums[0]), sum_of(sums[1]), sum_of(sums[2]), sum_of(sums[3])};
    after = product(own.upper, rest) - product(own.from_next, after);
    four(y) = after;
  }
}

NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::upper_transposed(Places& y, int first, int& last) const {
  for (int k = first; k <= last; ++k) {
    if (y[k] == 0) continue;
    y[k] *= inverse_pivot(k);
    const double* u = upper_row(k);
    const int end = std::min(k - k % block + blocks_[k / block].upper_length, padded_);
    for (int i = k + 1; i < end; ++i) y[i] -= u[i] * y[k];
    last = std::max(last, end - 1);
  }
}

// Of so many times four right-hand sides, side by side at each place.
template <int times>
NURBEAM_WITHIN void BandedLu::solve_beside(double* y) const {
  const auto at = [&](int place) { return reinterpret_cast<Four*>(y) + place * times; };
  const auto take_off = [&](Four* from, double factor, const Four* x) {
    for (int c = 0; c < times; ++c) from[c] -= factor * x[c];
  };
  for (int begin = 0; begin < padded_; begin += block) {
    const std::array<const double*, block> m = multipliers_below(begin);
    const int below = begin + block, reach = blocks_[begin / block].reach;
    const bool exchanged = blocks_[begin / block].exchanged;
    for (int k = begin; k < below; ++k) {
      if (pivots_[k] != k) std::swap_ranges(at(k), at(k + 1), at(pivots_[k]));
      for (int i = k + 1; i < std::min(below, reach + 1); ++i) take_off(at(i), multiplier(i, k), at(k));
      if (exchanged)  // rows that stay wait for all four
        for (int i = below; i <= reach; ++i) take_off(at(i), m[k - begin][i - below], at(k));
    }
    if (exchanged) continue;
    for (int i = below; i <= reach; ++i) {
      Four* row = at(i);
      const Four* x = at(begin);
      for (int c = 0; c < times; ++c) {
        Four rest = row[c];
        for (int r = 0; r < block; ++r) rest -= m[r][i - below] * x[r * times + c];
        row[c] = rest;
      }
    }
  }
  for (int k = padded_ - 1; k >= 0; --k) {
    const double* upper = upper_row(k);
    Four* own = at(k);
    const double inverse = inverse_pivot(k);
    Four x[times];
    for (int c = 0; c < times; ++c) x[c] = own[c];
    const int end = std::min(k - k % block + blocks_[k / block].upper_length, padded_);
    for (int j = k + 1; j < end; ++j)
      for (int c = 0; c < times; ++c) x[c] -= upper[j] * at(j)[c];
    for (int c = 0; c < times; ++c) own[c] = inverse * x[c];
  }
}

NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::solve_fours(int times, double* y) const {
  switch (times) {
    case 1:
      return solve_beside<1>(y);
    case 2:
      return solve_beside<2>(y);
    case 3:
      return solve_beside<3>(y);
    case 4:
      return solve_beside<4>(y);
    default:
      return solve_beside<5>(y);
  }
}

void BandedLu::solve(const Columns& rhs, Columns& x) const {
  constexpr Eigen::Index most = 5 * block;
  const auto n = static_cast<Eigen::Index>(order_->unknown.size());
  const Eigen::Index columns = rhs.cols();
  const auto room = padded_ * std::min(most, (columns + block - 1) / block * block);
  const auto y = std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(room));
  x.resize(rhs.rows(), columns);
  for (Eigen::Index first = 0; first < columns; first += most) {
    const Eigen::Index count = std::min(most, columns - first), times = (count + block - 1) / block,
                       width = times * block;
    for (Eigen::Index k = 0; k < n; ++k) {
      const int unknown = order_->unknown[k];
      const Eigen::Index held = unknown < 0 ? 0 : count;
      const double* from = rhs.data() + std::max(unknown, 0) * columns + first;
      double* to = y.get() + k * width;
      for (Eigen::Index c = 0; c < held; ++c) to[c] = scale_[k] * from[c];
      std::fill(to + held, to + width, 0.0);
    }
    std::fill_n(y.get() + n * width, (padded_ - n) * width, 0.0);
    solve_fours(static_cast<int>(times), y.get());
    for (Eigen::Index k = 0; k < n; ++k)
      if (const int unknown = order_->unknown[k]; unknown >= 0)
        std::copy_n(y.get() + k * width, count, x.data() + unknown * columns + first);
  }
}

}  // namespace nurbeam
