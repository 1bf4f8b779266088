#include "solver/banded_lu.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/every_processor.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr int block = 4;

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
    before_ = std::max(band, block);
    width_ = before_ + 2 * band + 4 * block;
    height_ = (band + 3 * block - 1) / block * block;
    const int open_at_once = 3 * band + 2 * block;
    capacity_ = std::min(3 * open_at_once, of.padded_ + band);
    const std::ptrdiff_t rows = std::ptrdiff_t{capacity_} * width_;
    of.window_.resize(static_cast<std::size_t>(rows + block * height_));
    of.window_ends_.resize(static_cast<std::size_t>(capacity_));
    rows_ = of.window_.data();
    ends_ = of.window_ends_.data();
    std::fill(scale_.begin(), scale_.end(), 0);
    multipliers_ = rows_ + rows;
  }

  NURBEAM_WITHIN double* diagonal(int row) { return rows_ + (row - begin_) * width_ + before_; }
  /// One past the last column of a row.
  NURBEAM_WITHIN int& end(int row) { return ends_[row - begin_]; }
  /// Of column c of the present block, from the block's first row on.
  NURBEAM_WITHIN double* multipliers(int c) { return multipliers_ + c * height_; }

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
      if (opened_ >= size_) *diagonal(opened_) = 1;
    }
  }

  void move_to_beginning() {
    std::copy(diagonal(first_) - before_, diagonal(opened_) - before_, rows_);
    std::copy(&end(first_), &end(opened_), ends_);
    begin_ = first_;
  }

  NURBEAM_WITHIN void fill_column(int column) {
    const int first = matrix_.outerIndexPtr()[order_.unknown[column]],
              end = matrix_.outerIndexPtr()[order_.unknown[column] + 1];
    open(order_.below[column]);
    double* entries = diagonal(0) + column;  // of that column, by the rows' distances
    for (int k = first; k < end; ++k)
      if (const int row = order_.place[matrix_.innerIndexPtr()[k]]; row >= 0) {
        const double value = matrix_.valuePtr()[k];
        entries[row * (width_ - 1)] = value;
        scale_[row] = std::max(scale_[row], std::abs(value));
      }
  }

  // So that its largest number becomes one.
  NURBEAM_WITHIN void scale(int row) {
    double* entries = diagonal(row) - before_;
    const int count = before_ + order_.ends[row] - row;
    const double scale = scale_[row] = scale_[row] > 0 ? 1 / scale_[row] : 1;
    for (int i = 0; i < count; ++i) entries[i] *= scale;
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

// Room for so many more numbers.
std::ptrdiff_t append(std::vector<double>& numbers, int count) {
  const std::size_t begin = numbers.size(), end = begin + static_cast<std::size_t>(count);
  if (end > numbers.capacity()) numbers.reserve(end + end / 8);
  numbers.resize(end);
  return static_cast<std::ptrdiff_t>(begin);
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
  upper_.clear();
  lower_.clear();
  upper_.reserve(upper + upper / 8);
  lower_.reserve(lower + lower / 8);
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

// Exchanges two rows from the first one's diagonal on.
template <class Window>
NURBEAM_WITHIN void exchange(Window& window, int k, int p) {
  const int end = std::max(window.end(k), window.end(p));
  std::swap_ranges(window.diagonal(k), window.diagonal(k) + end - k, window.diagonal(p) + k - p);
  std::swap(window.end(k), window.end(p));
}

// Takes the unknown of a column out of the rows below, down to `last`; returns the last one that changes.
template <class Window>
NURBEAM_WITHIN int take_out_of_rows(Window& window, int k, int last, double inverse) {
  const int length = window.end(k) - k, begin = k - k % block;
  const double* upper = window.diagonal(k);
  double* multipliers = window.multipliers(k % block) - begin;
  int reach = 0;
  for (int i = k + 1; i <= last; ++i) {
    double* below = window.diagonal(i) + k - i;
    const double factor = multipliers[i] = below[0] * inverse;
    if (factor == 0) continue;
    reach = i;
    window.end(i) = std::max(window.end(i), window.end(k));
    for (int j = 1; j < length; j += block) four(below + j) -= factor * four(upper + j);
  }
  return reach;
}

}  // namespace

// Puts the block's rows of U and columns of L away.
NURBEAM_WITHIN void BandedLu::keep_block(int k, Window& window) {
  Block& own = blocks_[k / block];
  int end = 0;
  for (int r = 0; r < block; ++r) end = std::max(end, window.end(k + r));
  const int upper = own.upper_length = rounded_length(k, end),
            lower = own.lower_length = rounded_length(k, own.reach + 1) - block;
  own.upper_begin = append(upper_, block * upper);
  own.lower_begin = append(lower_, block * lower);
  for (int r = 0; r < block; ++r) {
    std::copy_n(window.diagonal(k + r) - r, upper, upper_.data() + own.upper_begin + r * upper);
    for (int c = 0; c < r; ++c) upper_[own.upper_begin + r * upper + c] = window.multipliers(c)[r];
    std::copy_n(window.multipliers(r) + block, lower, lower_.data() + own.lower_begin + r * lower);
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
  for (int k = 0; k < padded_; ++k) {
    const int last = k < n ? order_->below[k] : k;
    if (k % block == 0) {
      window.begin_block(k);
      blocks_[k / block].reach = 0;
    }
    window.reach(last);
    const int p = pivots_[k] = pivot_of(window, k, last);
    if (p != k) exchange(window, k, p);
    const double pivot = *window.diagonal(k);
    if (pivot == 0) return 0;
    if (k < n) {
      smallest = std::min(smallest, std::abs(pivot));
      largest = std::max(largest, std::abs(pivot));
    }
    int& reach = blocks_[k / block].reach;
    reach = std::max(reach, take_out_of_rows(window, k, last, 1 / pivot));
    if (k % block != block - 1) continue;
    const int begin = k - k % block;
    keep_block(begin, window);
    invert_upper(begin);
    invert_lower(begin);
  }
  return largest > 0 ? smallest / largest : 0;
}

double BandedLu::factorise(const Matrix& matrix) {
  upper_.clear();
  lower_.clear();
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
  for (std::size_t k = 0; k < n; ++k) y[k] = scale_[k] * rhs[order_->unknown[k]];
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
  const int n = static_cast<int>(order_->unknown.size());
  Four x[times];
  for (int k = 0; k < n; ++k) {
    Four *own = at(k), *pivot = at(pivots_[k]);
    for (int c = 0; c < times; ++c) x[c] = pivot[c];
    if (own != pivot)
      for (int c = 0; c < times; ++c) std::swap(own[c], pivot[c]);
    const int below = k - k % block + block, last = std::min(order_->below[k], blocks_[k / block].reach);
    for (int i = k + 1; i < std::min(below, last + 1); ++i)
      for (int c = 0; c < times; ++c) at(i)[c] -= multiplier(i, k) * x[c];
    const double* m = multipliers_below(k)[k % block] - below;
    for (int i = below; i <= last; ++i)
      for (int c = 0; c < times; ++c) at(i)[c] -= m[i] * x[c];
  }
  for (int k = n - 1; k >= 0; --k) {
    const double* upper = upper_row(k);
    Four* own = at(k);
    const double inverse = inverse_pivot(k);
    for (int c = 0; c < times; ++c) x[c] = own[c];
    const int end = std::min(k - k % block + blocks_[k / block].upper_length, n);
    for (int j = k + 1; j < end; ++j)
      for (int c = 0; c < times; ++c) x[c] -= upper[j] * at(j)[c];
    for (int c = 0; c < times; ++c) own[c] = inverse * x[c];
  }
}

NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::solve_sixteen(double* y) const { solve_beside<4>(y); }
NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::solve_four(double* y) const { solve_beside<1>(y); }

void BandedLu::solve(const Columns& rhs, Columns& x) const {
  const auto n = static_cast<Eigen::Index>(order_->unknown.size());
  const Eigen::Index columns = rhs.cols();
  x.resize(rhs.rows(), columns);
  Eigen::VectorXd y(n * 16);
  for (Eigen::Index first = 0; first < columns;) {
    const Eigen::Index width = columns - first >= 16 ? 16 : 4, count = std::min(width, columns - first);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double* from = rhs.data() + order_->unknown[k] * columns + first;
      double* to = y.data() + k * width;
      for (Eigen::Index c = 0; c < count; ++c) to[c] = scale_[k] * from[c];
      for (Eigen::Index c = count; c < width; ++c) to[c] = 0;
    }
    width == 16 ? solve_sixteen(y.data()) : solve_four(y.data());
    for (Eigen::Index k = 0; k < n; ++k) {
      const double* from = y.data() + k * width;
      double* to = x.data() + order_->unknown[k] * columns + first;
      for (Eigen::Index c = 0; c < count; ++c) to[c] = from[c];
    }
    first += count;
  }
}

}  // namespace nurbeam
