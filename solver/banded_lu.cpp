#include "solver/banded_lu.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "solver/every_processor.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr int block = BandedLu::block;

using Four = BandedLu::Four;
NURBEAM_WITHIN Four& four(double* at) { return *reinterpret_cast<Four*>(at); }
NURBEAM_WITHIN const Four& four(const double* at) { return *reinterpret_cast<const Four*>(at); }
using Square = std::array<std::array<double, block>, block>;
NURBEAM_WITHIN Four product(const Square& columns, const Four& x) {
  return (four(columns[0].data()) * x[0] + four(columns[1].data()) * x[1]) +
         (four(columns[2].data()) * x[2] + four(columns[3].data()) * x[3]);
}
// The sum of the four.
NURBEAM_WITHIN double sum_of(const Four& a) { return (a[0] + a[2]) + (a[1] + a[3]); }

}  // namespace

// The rows that are being eliminated, each with what its columns take, and the multipliers of a block. They
// are filled column by column, as far as the next elimination needs; where there is no room for more, those
// that are left move to its beginning.
class BandedLu::Window {
 public:
  Window(BandedLu& of, const Matrix& matrix)
      : order_(*of.order_),
        matrix_(matrix),
        scale_(of.scale_),
        size_(static_cast<int>(order_.unknown.size())) {
    const int band = order_.half_bandwidth;
    before_ = band + block;
    width_ = before_ + 2 * band + 4 * block;
    height_ = (band + 3 * block - 1) / block * block;
    const int open_at_once = 3 * band + 2 * block;
    capacity_ = std::min(3 * open_at_once, of.padded_ + band);
    const std::ptrdiff_t rows = std::ptrdiff_t{capacity_} * width_;
    of.window_.resize(static_cast<std::size_t>(rows + block * height_));
    of.window_ends_.resize(static_cast<std::size_t>(capacity_));
    rows_ = of.window_.data();
    ends_ = of.window_ends_.data();
    multipliers_ = rows_ + rows;
  }

  NURBEAM_WITHIN double* diagonal(int row) { return rows_ + (row - begin_) * width_ + before_; }
  /// From a place in a row to the same column of the next one.
  NURBEAM_WITHIN std::ptrdiff_t to_next_row() const { return width_ - 1; }
  /// One past the last column of a row.
  NURBEAM_WITHIN int& end(int row) { return ends_[row - begin_]; }
  /// Of column c of the present block, from the block's first row on.
  NURBEAM_WITHIN double* multipliers(int c) { return multipliers_ + c * height_; }

  /// Whether no unknown has that place.
  NURBEAM_WITHIN bool is_free(int place) const { return place >= size_ || order_.unknown[place] < 0; }

  /// Makes room for a block: nothing before its first row is asked for any more.
  NURBEAM_WITHIN void begin_block(int k) {
    std::fill_n(multipliers_, block * height_, 0.0);
    first_ = k;
  }
  /// Makes the rows up to that one complete.
  NURBEAM_WITHIN void reach(int row) {
    for (; complete_ <= row && complete_ < size_; ++complete_) {
      while (filled_ < order_.ends[complete_]) fill_column(filled_++);
      scale(complete_);
    }
    open(row);
  }

 private:
  NURBEAM_WITHIN void open(int row) {
    for (; opened_ <= row; ++opened_) {
      if (opened_ - begin_ == capacity_) move_to_beginning();
      std::fill_n(diagonal(opened_) - before_, width_, 0.0);
      end(opened_) = opened_ < size_ ? order_.ends[opened_] : opened_ + 1;
      if (is_free(opened_)) *diagonal(opened_) = 1;
    }
  }

  void move_to_beginning() {
    std::copy(diagonal(first_) - before_, diagonal(opened_) - before_, rows_);
    std::copy(&end(first_), &end(opened_), ends_);
    begin_ = first_;
  }

  NURBEAM_WITHIN void fill_column(int column) {
    if (order_.unknown[column] < 0) return;
    const int first = matrix_.outerIndexPtr()[order_.unknown[column]],
              end = matrix_.outerIndexPtr()[order_.unknown[column] + 1];
    open(order_.below[column]);
    double* entries = diagonal(0) + column;  // of that column, by the rows' distances
    for (int k = first; k < end; ++k)
      if (const int row = order_.place[matrix_.innerIndexPtr()[k]]; row >= 0)
        entries[row * to_next_row()] = matrix_.valuePtr()[k];
  }

  // So that its largest number becomes one; before and behind its numbers are zeros.
  NURBEAM_WITHIN void scale(int row) {
    double* entries = diagonal(row) - before_;
    const int count = before_ + order_.ends[row] - row;
    Four greatest = {};
    for (int i = 0; i < count; i += block) {
      const Four x = four(entries + i), size = x < 0 ? -x : x;
      greatest = size > greatest ? size : greatest;
    }
    const double largest = std::max(std::max(greatest[0], greatest[1]), std::max(greatest[2], greatest[3]));
    const double scale = scale_[row] = largest > 0 ? 1 / largest : 1;
    for (int i = 0; i < count; i += block) four(entries + i) *= scale;
  }

  const BandOrder& order_;
  const Matrix& matrix_;
  std::vector<double>& scale_;
  int size_, before_, width_, height_, capacity_;
  int begin_ = 0, first_ = 0;                   // row at the beginning, and first one that is needed
  int opened_ = 0, filled_ = 0, complete_ = 0;  // rows, columns, rows
  double *rows_, *multipliers_;
  int* ends_;
};

namespace {

// Copies so many numbers, which are whole blocks.
NURBEAM_WITHIN void copy(const double* from, int count, double* to) {
  for (int j = 0; j < count; j += block) four(to + j) = four(from + j);
}

// Numbers of four rows of U, or columns of L, from place k on: with what is taken out of the next block. Of L
// those within the block stand where U has none.
int rounded_length(int k, int end) { return std::max(2 * block, (end - k + block - 1) / block * block); }

}  // namespace

// All is done by blocks of four; what they reach beyond that is zero.
void BandedLu::take(std::shared_ptr<const BandOrder> order) {
  order_ = std::move(order);
  half_bandwidth_ = order_->half_bandwidth;
  const int n = static_cast<int>(order_->unknown.size());
  padded_ = (n + block - 1) / block * block;
  const auto padded = static_cast<std::size_t>(padded_);
  scale_.resize(order_->unknown.size());
  pivots_.resize(padded);
  blocks_.resize(padded / block);
  room_ = padded + static_cast<std::size_t>(2 * half_bandwidth_ + 2 * block);
  // As long as they are without exchanges, and an eighth for these.
  std::size_t upper = 0, lower = 0;
  for (int k = 0, row = 0, longest = 0; k < padded_; k += block) {
    for (; row < std::min(k + block, n); ++row) longest = std::max(longest, order_->ends[row]);
    upper += static_cast<std::size_t>(block * rounded_length(k, longest));
    lower += static_cast<std::size_t>(block * (rounded_length(k, order_->below[row - 1] + 1) - block));
  }
  upper_.resize(upper + upper / 8);
  lower_.resize(lower + lower / 8);
}

namespace {

// The row, down to `last`, that takes the place: the one that is there if it is not much less than the
// largest, since every exchange widens the band.
template <class Window>
NURBEAM_WITHIN int pivot_of(Window& window, int column, int last) {
  constexpr double enough = 0.1;
  const auto size = [&](int i) { return std::abs(window.diagonal(i)[column - i]); };
  int pivot = column;
  double largest = size(column) / enough;
  for (int i = column + 1; i <= last; ++i)
    if (size(i) > largest) {
      largest = size(i);
      pivot = i;
    }
  return pivot;
}

// Exchanges two rows from the first column of a block on.
template <class Window>
NURBEAM_WITHIN void exchange(Window& window, int k, int p) {
  const int begin = k - k % block, end = std::max(window.end(k), window.end(p));
  double* row = window.diagonal(k) - k;
  std::swap_ranges(row + begin, row + end, window.diagonal(p) - p + begin);
  std::swap(window.end(k), window.end(p));
}

// Takes the unknown of a column out of the rows below, down to `last`, within the columns of its block: where
// it was stands what it is multiplied with in the others. Returns the last row that changes.
template <class Window>
NURBEAM_WITHIN int take_out_of_block(Window& window, int k, int last, double inverse) {
  const int column = k % block, begin = k - column, end = window.end(k);
  Four upper = four(window.diagonal(k) - column);
  for (int c = 0; c <= column; ++c) upper[c] = 0;
  double *multipliers = window.multipliers(column) - begin, *below = window.diagonal(k) - column;
  int reach = 0;
  for (int i = k + 1; i <= last; ++i) {
    below += window.to_next_row();
    const double factor = multipliers[i] = below[column] * inverse;
    if (factor == 0) continue;
    reach = i;
    window.end(i) = std::max(window.end(i), end);
    four(below) -= factor * upper;
    below[column] = factor;
  }
  return reach;
}

// Takes the unknowns of a block out of the columns beyond it: of its own rows, then of those below, down to
// `last`.
template <class Window>
NURBEAM_WITHIN void take_out_beyond(Window& window, int k, int last) {
  std::array<double*, block> u;
  int end = 0;
  for (int r = 0; r < block; ++r) {
    u[r] = window.diagonal(k + r) - r;
    end = std::max(end, window.end(k + r));
  }
  const int length = end - k;
  for (int j = block; j < length; j += block)
    for (int r = 1; r < block; ++r) {
      Four rest = four(u[r] + j);
      for (int c = 0; c < r; ++c) rest -= u[r][c] * four(u[c] + j);
      four(u[r] + j) = rest;
    }
  double* row = u[block - 1];
  for (int i = k + block; i <= last; ++i) {
    row += window.to_next_row();
    const Four m = four(row);
    for (int j = block; j < length; j += block) {
      Four rest = four(row + j);
      for (int c = 0; c < block; ++c) rest -= m[c] * four(u[c] + j);
      four(row + j) = rest;
    }
  }
}

}  // namespace

// Room for so many more numbers behind `end`, which moves.
std::ptrdiff_t BandedLu::append(int count, std::size_t& end, std::vector<double>& numbers) {
  const std::size_t begin = end;
  end += static_cast<std::size_t>(count);
  if (end > numbers.size()) numbers.resize(end + end / 8);
  return static_cast<std::ptrdiff_t>(begin);
}

// Puts the block's rows of U and columns of L away.
NURBEAM_WITHIN void BandedLu::keep_block(int k, Window& window) {
  Block& own = blocks_[k / block];
  int end = 0;
  for (int r = 0; r < block; ++r) end = std::max(end, window.end(k + r));
  const int upper = own.upper_length = rounded_length(k, end),
            lower = own.lower_length = rounded_length(k, own.reach + 1) - block;
  own.upper_begin = append(block * upper, upper_end_, upper_);
  own.lower_begin = append(block * lower, lower_end_, lower_);
  double *of_upper = upper_.data() + own.upper_begin, *of_lower = lower_.data() + own.lower_begin;
  for (int r = 0; r < block; ++r, of_upper += upper, of_lower += lower) {
    copy(window.diagonal(k + r) - r, upper, of_upper);
    for (int c = 0; c < r; ++c) of_upper[c] = window.multipliers(c)[r];
    copy(window.multipliers(r) + block, lower, of_lower);
  }
}

NURBEAM_WITHIN void BandedLu::invert_upper(int k) {
  std::array<const double*, block> u;  // from column k on
  for (int r = 0; r < block; ++r) u[r] = upper_row(k + r) + k;
  Square &inverse = blocks_[k / block].upper, &next = blocks_[k / block].from_next;
  for (int j = 0; j < block; ++j) {
    inverse[j] = {};
    inverse[j][j] = 1 / u[j][j];
    for (int i = j - 1; i >= 0; --i) {
      double sum = 0;
      for (int l = i + 1; l <= j; ++l) sum += u[i][l] * inverse[j][l];
      inverse[j][i] = -inverse[i][i] * sum;
    }
  }
  for (int j = 0; j < block; ++j) {
    Four sum = {};
    for (int r = 0; r < block; ++r) sum += four(inverse[r].data()) * u[r][block + j];
    four(next[j].data()) = sum;
  }
}

NURBEAM_WITHIN void BandedLu::invert_lower(int k) {
  Block& own = blocks_[k / block];
  own.exchanged = false;
  for (int c = 0; c < block; ++c) own.exchanged |= pivots_[k + c] != k + c;
  if (own.exchanged) return;
  for (int j = 0; j < block; ++j) {
    own.lower[j] = {};
    own.lower[j][j] = 1;
    for (int i = j + 1; i < block; ++i)
      for (int l = j; l < i; ++l) own.lower[j][i] -= multiplier(k + i, k + l) * own.lower[j][l];
  }
  if (k == 0 || blocks_[k / block - 1].exchanged) return;
  const std::array<const double*, block> before = multipliers_below(k - block);
  for (int j = 0; j < block; ++j) four(own.from_previous[j].data()) = product(own.lower, four(before[j]));
}

NURBEAM_FOR_EVERY_PROCESSOR double BandedLu::eliminate_rows(const Matrix& matrix) {
  const int n = static_cast<int>(order_->unknown.size());
  Window window(*this, matrix);
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (int begin = 0; begin < padded_; begin += block) {
    window.begin_block(begin);
    int& reach = blocks_[begin / block].reach = 0;
    int brought = 0;  // the last row that one with multipliers may have gone to
    for (int k = begin; k < begin + block; ++k) {
      const int last = k < n ? order_->below[k] : k;
      window.reach(last);
      const int p = pivots_[k] = pivot_of(window, k, last);
      if (p != k) exchange(window, k, p);
      brought = std::max(brought, p);
      const double pivot = *window.diagonal(k);
      if (pivot == 0) return 0;
      if (!window.is_free(k)) {
        smallest = std::min(smallest, std::abs(pivot));
        largest = std::max(largest, std::abs(pivot));
      }
      reach = std::max(reach, take_out_of_block(window, k, last, 1 / pivot));
    }
    take_out_beyond(window, begin, std::max(reach, brought));
    keep_block(begin, window);
    invert_upper(begin);
    invert_lower(begin);
  }
  return largest > 0 ? smallest / largest : 0;
}

double BandedLu::factorise(const Matrix& matrix) {
  upper_end_ = lower_end_ = 0;
  return order_->unknown.empty() ? 1 : eliminate_rows(matrix);
}

NURBEAM_WITHIN double BandedLu::inverse_pivot(int k) const {
  return blocks_[k / block].upper[k % block][k % block];
}

// From column 0 on, if it were so long.
NURBEAM_WITHIN const double* BandedLu::upper_row(int k) const {
  const Block& own = blocks_[k / block];
  const int row = k % block;
  return upper_.data() + own.upper_begin + row * own.upper_length - (k - row);
}

// Within a block.
NURBEAM_WITHIN double BandedLu::multiplier(int row, int column) const { return upper_row(row)[column]; }

// Of the rows below a block, of each of its columns.
NURBEAM_WITHIN std::array<const double*, block> BandedLu::multipliers_below(int k) const {
  const Block& own = blocks_[k / block];
  std::array<const double*, block> m;
  for (int c = 0; c < block; ++c) m[c] = lower_.data() + own.lower_begin + c * own.lower_length;
  return m;
}

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
