#include <algorithm>
#include <memory>
#include <utility>

#include "solver/algebra/banded_lu_parts.h"

namespace nurbeam {

using namespace fours;

namespace {

// The sum of the four numbers.
NURBEAM_WITHIN double sum_of(const Four& a) { return (a[0] + a[2]) + (a[1] + a[3]); }

}  // namespace

// Subtracts a block of unknowns from the right-hand sides beyond the next block.
NURBEAM_WITHIN void BandedLu::take_out(int k, const Four& x, double* y) const {
  const std::array<const double*, block> m = multipliers_beyond(k);
  for (int i = 0; k + 2 * block + i <= blocks_[k / block].reach; i += block)
    four(y + 2 * block + i) -=
        four(m[0] + i) * x[0] + four(m[1] + i) * x[1] + four(m[2] + i) * x[2] + four(m[3] + i) * x[3];
}

// Finds the unknowns of a block with exchanged rows, and subtracts them from the right-hand sides below.
// exchange(place, other) exchanges two places; take_off(place, factor, other) subtracts factor times the
// value at another place.
template <class Exchange, class TakeOff>
NURBEAM_WITHIN void BandedLu::eliminate_exchanged(int k, const Exchange& exchange,
                                                  const TakeOff& take_off) const {
  const Block& own = blocks_[k / block];
  const std::array<const double*, block> beyond = multipliers_beyond(k);
  for (int c = 0; c < block; ++c) {
    if (pivots_[k + c] != k + c) exchange(k + c, pivots_[k + c]);
    for (int i = c + 1; i < block; ++i) take_off(k + i, own.inverses[c][i], k + c);
    for (int i = k + block; i <= own.reach; ++i) {
      const int below = i - k - block;
      take_off(i, below < block ? blocks_[k / block + 1].from_previous[c][below] : beyond[c][below - block],
               k + c);
    }
  }
}

// Finds the unknowns block by block, and subtracts each block from the right-hand sides after it; from the
// next block when its turn comes.
class BandedLu::Elimination {
 public:
  NURBEAM_WITHIN Elimination(const BandedLu& lu, double* all) : lu_(lu), all_(all) {}

  NURBEAM_WITHIN void eliminate(int k) {
    const Block& own = lu_.blocks_[k / block];
    double* y = all_ + k;
    if (own.exchanged) {
      if (is_waiting_)
        for (int c = 0; c < block; ++c) four(y) -= four(own.from_previous[c].data()) * before_[c];
      lu_.eliminate_exchanged(
          k, [&](int i, int j) { std::swap(all_[i], all_[j]); },
          [&](int i, double factor, int j) { all_[i] -= factor * all_[j]; });
    } else {
      Four x = lower_product(own.inverses, four(y));
      if (is_waiting_) x -= product(own.from_previous, before_);
      four(y) = before_ = x;
      lu_.take_out(k, x, y);
    }
    is_waiting_ = !own.exchanged;
  }
  // Skips a block of zeros.
  NURBEAM_WITHIN void pass() { is_waiting_ = false; }
  NURBEAM_WITHIN bool is_waiting() const { return is_waiting_; }

 private:
  const BandedLu& lu_;
  double* all_;
  Four before_ = {};
  bool is_waiting_ = false;  // whether the block before is still to be subtracted from the next one
};

void BandedLu::load(const Eigen::VectorXd& rhs, Places& y) const {
  const std::size_t n = order_->unknown.size();
  for (std::size_t k = 0; k < n; ++k) {
    const int unknown = order_->unknown[k];
    y[k] = unknown < 0 ? 0 : scale_[k] * rhs[unknown];
  }
  std::fill(y.begin() + static_cast<std::ptrdiff_t>(n), y.end(), 0);
}

NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::lower(Places& all) const {
  Elimination elimination(*this, all.data());
  for (int k = 0; k < padded_; k += block) elimination.eliminate(k);
}

NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::lower(Places& y, int first, int& last) const {
  Elimination elimination(*this, y.data());
  // An exchange moves a row up by no more than the bandwidth.
  for (int k = std::max(0, first - half_bandwidth_) / block * block; k <= last; k += block) {
    const auto is_zero = [&](int i) { return y[i] == 0 && y[pivots_[i]] == 0; };
    if (!elimination.is_waiting() && is_zero(k) && is_zero(k + 1) && is_zero(k + 2) && is_zero(k + 3))
      continue;
    elimination.eliminate(k);
    const int reach = std::max(blocks_[k / block].reach, *std::max_element(&pivots_[k], &pivots_[k] + block));
    if (reach < k + block) elimination.pass();
    last = std::max(last, reach);
  }
}

// Each block is found from those after it. The next block enters last, as its result has to be waited for.
NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::upper(Places& all) const {
  Four after = {};
  for (int k = padded_ - block; k >= 0; k -= block) {
    const Block& own = blocks_[k / block];
    const double* u = upper_.data() + own.upper_begin;
    double* y = all.data() + k;
    const int length = own.upper_length;
    Four sums[block] = {};
    for (int j = 0; j < length; j += block)
      for (int r = 0; r < block; ++r) sums[r] += four(u + r * length + j) * four(y + 2 * block + j);
    const Four rest = four(y) - Four{sum_of(sums[0]), sum_of(sums[1]), sum_of(sums[2]), sum_of(sums[3])};
    after = upper_product(own.inverses, rest) - product(own.from_next, after);
    four(y) = after;
  }
}

NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::upper_transposed(Places& all, int first, int& last) const {
  for (int k = first / block * block; k <= last; k += block) {
    const Block& own = blocks_[k / block];
    double* y = all.data() + k;
    const Four rest = four(y);
    if (rest[0] == 0 && rest[1] == 0 && rest[2] == 0 && rest[3] == 0) continue;
    for (int c = 0; c < block; ++c) {
      y[c] = 0;
      for (int r = 0; r <= c; ++r) y[c] += own.inverses[c][r] * rest[r];
      y[block + c] -= sum_of(four(own.from_next[c].data()) * rest);
    }
    const Four x = four(y);
    const std::array<const double*, block> u = upper_beyond(k);
    for (int j = 0; j < own.upper_length; j += block)
      for (int r = 0; r < block; ++r) four(y + 2 * block + j) -= four(u[r] + j) * x[r];
    last = std::max(last, std::min(k + 2 * block + own.upper_length, padded_) - 1);
  }
}

// y <- (P L)^-1 y for `times` times four right-hand sides, side by side at each place.
template <int times>
NURBEAM_WITHIN void BandedLu::lower_beside(double* y) const {
  const auto at = [&](int place) { return reinterpret_cast<Four*>(y) + place * times; };
  const auto take_off = [&](int place, double factor, int other) {
    for (int c = 0; c < times; ++c) at(place)[c] -= factor * at(other)[c];
  };
  bool is_waiting = false;
  for (int k = 0; k < padded_; k += block) {
    const Block& own = blocks_[k / block];
    // Rows within the block go from below, as each needs the old values of the rows above it.
    if (!own.exchanged)
      for (int i = block - 1; i > 0; --i)
        for (int l = 0; l < i; ++l) take_off(k + i, -own.inverses[l][i], k + l);
    for (int i = 0; is_waiting && i < block; ++i)
      for (int l = 0; l < block; ++l) take_off(k + i, own.from_previous[l][i], k - block + l);
    if (own.exchanged) {
      eliminate_exchanged(
          k, [&](int i, int j) { std::swap_ranges(at(i), at(i + 1), at(j)); }, take_off);
    } else {
      const std::array<const double*, block> m = multipliers_beyond(k);
      for (int i = 0; k + 2 * block + i <= own.reach; ++i)
        for (int l = 0; l < block; ++l) take_off(k + 2 * block + i, m[l][i], k + l);
    }
    is_waiting = !own.exchanged;
  }
}

// y <- U^-1 y for `times` times four right-hand sides.
template <int times>
NURBEAM_WITHIN void BandedLu::upper_beside(double* y) const {
  const auto at = [&](int place) { return reinterpret_cast<Four*>(y) + place * times; };
  for (int k = padded_ - block; k >= 0; k -= block) {
    const Block& own = blocks_[k / block];
    const std::array<const double*, block> u = upper_beyond(k);
    const int length = std::min(own.upper_length, padded_ - k - 2 * block);
    for (int r = 0; r < block; ++r)
      for (int j = 0; j < length; ++j)
        for (int c = 0; c < times; ++c) at(k + r)[c] -= u[r][j] * at(k + 2 * block + j)[c];
    for (int r = 0; r < block; ++r)
      for (int c = 0; c < times; ++c) {
        Four x = own.inverses[r][r] * at(k + r)[c];
        for (int l = r + 1; l < block; ++l) x += own.inverses[l][r] * at(k + l)[c];
        for (int l = 0; k + block < padded_ && l < block; ++l)
          x -= own.from_next[l][r] * at(k + block + l)[c];
        at(k + r)[c] = x;
      }
  }
}

NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::solve_fours(int times, double* y) const {
  const auto solve = [&]<int count>() {
    lower_beside<count>(y);
    upper_beside<count>(y);
  };
  switch (times) {
    case 1:
      return solve.template operator()<1>();
    case 2:
      return solve.template operator()<2>();
    case 3:
      return solve.template operator()<3>();
    case 4:
      return solve.template operator()<4>();
    default:
      return solve.template operator()<5>();
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
