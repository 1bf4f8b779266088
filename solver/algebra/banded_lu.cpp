#include "solver/algebra/banded_lu.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/algebra/banded_lu_parts.h"

namespace nurbeam {

using namespace fours;

// A window on the rows that are being eliminated, each with room for its columns, and the multipliers of a
// block. Rows are filled column by column, as far as the next elimination needs. When the room is used up,
// the rows still needed move to its beginning.
class BandedLu::Window {
 public:
  Window(BandedLu& of, const SparseView& matrix)
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
    if (!of.window_) {
      of.window_ = std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(rows + block * height_));
      of.window_ends_ = std::make_unique_for_overwrite<int[]>(static_cast<std::size_t>(capacity_));
    }
    rows_ = of.window_.get();
    ends_ = of.window_ends_.get();
    multipliers_ = rows_ + rows;
  }

  NURBEAM_WITHIN double* diagonal(int row) { return rows_ + (row - begin_) * width_ + before_; }
  /// Distance from a place in a row to the same column of the next row.
  NURBEAM_WITHIN std::ptrdiff_t to_next_row() const { return width_ - 1; }
  /// End of a row: one past its last column.
  NURBEAM_WITHIN int& end(int row) { return ends_[row - begin_]; }
  /// Multipliers of column c of the present block, from the block's first row on.
  NURBEAM_WITHIN double* multipliers(int c) { return multipliers_ + c * height_; }

  /// Whether a place has no unknown.
  NURBEAM_WITHIN bool is_free(int place) const { return place >= size_ || order_.unknown[place] < 0; }

  /// Makes room for a block; rows before its first one are not needed any more.
  NURBEAM_WITHIN void begin_block(int k) {
    std::fill_n(multipliers_, block * height_, 0.0);
    first_ = k;
  }
  /// Completes the rows up to `row`.
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
    double* entries = diagonal(0) + column;  // entries of the column, by the rows' distances
    for (int k = first; k < end; ++k)
      if (const int row = order_.place[matrix_.innerIndexPtr()[k]]; row >= 0)
        entries[row * to_next_row()] = matrix_.valuePtr()[k];
  }

  // Scales a row so that its largest number becomes one; the numbers before and behind it are zeros.
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
  const SparseView& matrix_;
  std::vector<double>& scale_;
  int size_, before_, width_, height_, capacity_;
  int begin_ = 0, first_ = 0;                   // row at the beginning, and first row that is needed
  int opened_ = 0, filled_ = 0, complete_ = 0;  // number of rows, columns, rows
  double *rows_, *multipliers_;
  int* ends_;
};

namespace {

// Copies `count` numbers, which are whole blocks.
NURBEAM_WITHIN void copy(const double* from, int count, double* to) {
  for (int j = 0; j < count; j += block) four(to + j) = four(from + j);
}

// Count of numbers of four rows of U, or columns of L, from place k to `end`, that lie beyond the next block.
int length_beyond(int k, int end) { return std::max(0, (end - k - block - 1) / block * block); }

}  // namespace

// Work goes by blocks of four; numbers in their reach beyond the end are zero.
void BandedLu::take(std::shared_ptr<const BandOrder> order) {
  order_ = std::move(order);
  window_.reset();
  half_bandwidth_ = order_->half_bandwidth;
  const int n = static_cast<int>(order_->unknown.size());
  padded_ = (n + block - 1) / block * block;
  const auto padded = static_cast<std::size_t>(padded_);
  scale_.resize(order_->unknown.size());
  pivots_.resize(padded);
  blocks_.resize(padded / block);
  room_ = padded + static_cast<std::size_t>(2 * half_bandwidth_ + 2 * block);
  // Room for the factors without exchanges, and an eighth more for exchanges.
  std::size_t upper = 0, lower = 0;
  for (int k = 0, row = 0, longest = 0; k < padded_; k += block) {
    for (; row < std::min(k + block, n); ++row) longest = std::max(longest, order_->ends[row]);
    upper += static_cast<std::size_t>(block * length_beyond(k, longest));
    lower += static_cast<std::size_t>(block * length_beyond(k, order_->below[row - 1] + 1));
  }
  upper_.resize(upper + upper / 8);
  lower_.resize(lower + lower / 8);
}

namespace {

// The pivot row, down to `last`: the present row unless it is much smaller than the largest, as every
// exchange widens the band.
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

// Eliminates the unknown of a column from the rows below, down to `last`, within the columns of its block.
// Multipliers take the place of the unknown's entries. Returns the last row that changes.
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

// Eliminates the unknowns of a block from the columns beyond it: in its own rows, then in those below, down
// to `last`.
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

// Makes room for `count` more numbers behind `end`, which moves on.
std::ptrdiff_t BandedLu::append(int count, std::size_t& end, std::vector<double>& numbers) {
  const std::size_t begin = end;
  end += static_cast<std::size_t>(count);
  if (end > numbers.size()) numbers.resize(end + end / 8);
  return static_cast<std::ptrdiff_t>(begin);
}

// Stores the block's rows of U and columns of L, without those that go into its inverses.
NURBEAM_WITHIN void BandedLu::keep_block(int k, Window& window) {
  Block& own = blocks_[k / block];
  int end = 0;
  for (int r = 0; r < block; ++r) end = std::max(end, window.end(k + r));
  const int upper = own.upper_length = length_beyond(k, end),
            lower = own.lower_length = length_beyond(k, own.reach + 1);
  own.upper_begin = append(block * upper, upper_end_, upper_);
  own.lower_begin = append(block * lower, lower_end_, lower_);
  double *of_upper = upper_.data() + own.upper_begin, *of_lower = lower_.data() + own.lower_begin;
  for (int r = 0; r < block; ++r, of_upper += upper, of_lower += lower) {
    copy(window.diagonal(k + r) - r + 2 * block, upper, of_upper);
    copy(window.multipliers(r) + 2 * block, lower, of_lower);
  }
}

// Finds D^-1 and D^-1 E.
NURBEAM_WITHIN void BandedLu::invert_upper(int k, Window& window) {
  std::array<const double*, block> u;  // rows of U from column k on
  for (int r = 0; r < block; ++r) u[r] = window.diagonal(k + r) - r;
  Square &inverse = blocks_[k / block].inverses, &next = blocks_[k / block].from_next;
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

// Finds C^-1 and C^-1 B of a block whose B is known, and gives the next block its B.
NURBEAM_WITHIN void BandedLu::invert_lower(int k, Window& window) {
  Block& own = blocks_[k / block];
  own.exchanged = false;
  for (int c = 0; c < block; ++c) own.exchanged |= pivots_[k + c] != k + c;
  Square lower = {};
  for (int j = 0; j < block; ++j) {
    lower[j][j] = 1;
    for (int i = j + 1; i < block; ++i)
      for (int l = j; l < i; ++l) lower[j][i] -= window.multipliers(l)[i] * lower[j][l];
  }
  for (int j = 0; j < block; ++j) {
    const double* kept = own.exchanged ? window.multipliers(j) : lower[j].data();
    std::copy(kept + j + 1, kept + block, own.inverses[j].begin() + j + 1);
    if (k + block < padded_)
      four(blocks_[k / block + 1].from_previous[j].data()) = four(window.multipliers(j) + block);
  }
  if (k == 0 || own.exchanged || blocks_[k / block - 1].exchanged) return;
  for (auto& column : own.from_previous) four(column.data()) = product(lower, four(column.data()));
}

NURBEAM_FOR_EVERY_PROCESSOR double BandedLu::eliminate_rows(const SparseView& matrix) {
  const int n = static_cast<int>(order_->unknown.size());
  Window window(*this, matrix);
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (int begin = 0; begin < padded_; begin += block) {
    window.begin_block(begin);
    int& reach = blocks_[begin / block].reach = 0;
    int brought = 0;  // last row to which a row with multipliers may have gone
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
    invert_upper(begin, window);
    invert_lower(begin, window);
  }
  return largest > 0 ? smallest / largest : 0;
}

double BandedLu::factorise(const SparseView& matrix) {
  upper_end_ = lower_end_ = 0;
  return order_->unknown.empty() ? 1 : eliminate_rows(matrix);
}

}  // namespace nurbeam
