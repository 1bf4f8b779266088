#include "solver/banded_lu.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "solver/close_order.h"
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
// A number of each of eight right-hand sides.
NURBEAM_WITHIN double sum_of(const Four& a) { return (a[0] + a[2]) + (a[1] + a[3]); }

// The unknowns that each is coupled with: itself too, and the rows of its column alone.
class Neighbours {
 public:
  Neighbours(const Matrix& pattern, const std::vector<int>& left_out)
      : pattern_(pattern), coupled_(static_cast<std::size_t>(pattern.cols()), false) {
    for (const int i : left_out)
      for (const int* other = begin(i); other != end(i); ++other) coupled_[*other] = true;
  }

  int size() const { return static_cast<int>(pattern_.cols()); }
  int count(int i) const { return pattern_.outerIndexPtr()[i + 1] - pattern_.outerIndexPtr()[i]; }
  const int* begin(int i) const { return pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[i]; }
  const int* end(int i) const { return begin(i) + count(i); }
  /// Whether it is coupled with what is left out.
  bool is_coupled(int i) const { return coupled_[i]; }

 private:
  const Matrix& pattern_;
  std::vector<bool> coupled_;
};

// Which unknowns have been seen, and in which walk last; those that are left out are in none.
struct Walks {
  static constexpr int never = std::numeric_limits<int>::max();
  std::vector<int> last;
  int number = 0;
};

// Appends the component of `start`, by levels, in each those first that are coupled with what is left out,
// then those with the fewest neighbours. Returns the number of levels.
int append_by_levels(const Neighbours& neighbours, int start, Walks& walks, std::vector<int>& order) {
  const auto rank = [&](int i) { return neighbours.is_coupled(i) ? 0 : neighbours.count(i); };
  const auto fewer = [&](int a, int b) { return rank(a) < rank(b); };
  const auto append = [&](int unknown) {
    walks.last[unknown] = walks.number;
    order.push_back(unknown);
  };
  ++walks.number;
  std::size_t next = order.size(), level_end = next + 1;
  int levels = 1;
  append(start);
  for (; next < order.size(); ++next) {
    if (next == level_end) {
      ++levels;
      level_end = order.size();
    }
    const std::size_t first_new = order.size();
    for (const int* other = neighbours.begin(order[next]); other != neighbours.end(order[next]); ++other)
      if (walks.last[*other] < walks.number) append(*other);
    // They are few.
    for (std::size_t i = first_new; i < order.size(); ++i)
      std::rotate(std::upper_bound(order.begin() + static_cast<std::ptrdiff_t>(first_new),
                                   order.begin() + static_cast<std::ptrdiff_t>(i), order[i], fewer),
                  order.begin() + static_cast<std::ptrdiff_t>(i),
                  order.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
  return levels;
}

// The component of `start`, by levels from an unknown at one of its ends: from there they are the most that
// are easily found. From one that is coupled with what is left out, where from it they are nearly as many.
std::vector<int> by_levels_from_end(const Neighbours& neighbours, int start, Walks& walks) {
  constexpr double nearly = 0.75;
  std::vector<int> order;
  for (int levels = 0;;) {
    order.clear();
    const int found = append_by_levels(neighbours, start, walks, order);
    if (found <= levels) {
      const auto coupled =
          std::find_if(order.begin(), order.end(), [&](int i) { return neighbours.is_coupled(i); });
      if (coupled == order.end()) return order;
      std::vector<int> other;
      const int others = append_by_levels(neighbours, *coupled, walks, other);
      return others >= nearly * levels ? other : order;
    }
    levels = found;
    start = order.back();
  }
}

// The reverse order of Cuthill and McKee.
std::vector<int> by_levels(const Neighbours& neighbours, const std::vector<int>& left_out) {
  const int n = neighbours.size();
  Walks walks{std::vector<int>(static_cast<std::size_t>(n), 0)};
  for (const int i : left_out) walks.last[i] = Walks::never;
  std::vector<int> order;
  for (int i = 0; i < n; ++i)
    if (walks.last[i] == 0) {
      const std::vector<int> component = by_levels_from_end(neighbours, i, walks);
      order.insert(order.end(), component.begin(), component.end());
    }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

BandOrder::BandOrder(const Matrix& pattern, const std::vector<int>& left_out) {
  std::optional<std::vector<int>> close = close_order(pattern, left_out);
  unknown = close ? std::move(*close) : by_levels(Neighbours(pattern, left_out), left_out);
  place_unknowns(pattern);
}

BandOrder BandOrder::of(const Matrix& pattern, std::vector<int> unknowns) {
  BandOrder order;
  order.unknown = std::move(unknowns);
  order.place_unknowns(pattern);
  return order;
}

// All that follows from `unknown`.
void BandOrder::place_unknowns(const Matrix& pattern) {
  place.assign(static_cast<std::size_t>(pattern.cols()), -1);
  const int held = static_cast<int>(unknown.size());
  ends.resize(unknown.size());
  for (int k = 0; k < held; ++k) place[unknown[k]] = k;
  // Calls visit(row, column, index of the value) for each entry, column by column.
  const auto for_each_entry = [&](const auto& visit) {
    for (int column = 0; column < held; ++column)
      for (int k = pattern.outerIndexPtr()[unknown[column]]; k < pattern.outerIndexPtr()[unknown[column] + 1];
           ++k)
        if (const int row = place[pattern.innerIndexPtr()[k]]; row >= 0) visit(row, column, k);
  };
  row_starts.assign(unknown.size() + 1, 0);
  for_each_entry([&](int row, int, int) { ++row_starts[row + 1]; });
  std::partial_sum(row_starts.begin(), row_starts.end(), row_starts.begin());
  entries.resize(static_cast<std::size_t>(row_starts.back()));
  std::vector<int> next = row_starts;
  for_each_entry([&](int row, int column, int value) { entries[next[row]++] = {column, value}; });
  // The entries of a row are in order.
  below.assign(unknown.size(), 0);
  for (int row = 0; row < held; ++row) {
    ends[row] = row + 1;
    if (row_starts[row] == row_starts[row + 1]) continue;
    const int first = entries[row_starts[row]].column, last = entries[row_starts[row + 1] - 1].column;
    ends[row] = std::max(ends[row], last + 1);
    half_bandwidth = std::max({half_bandwidth, row - first, last - row});
    below[first] = row;
  }
  for (int column = 1; column < held; ++column) below[column] = std::max(below[column], below[column - 1]);
}

// Rows and columns of multipliers are as long as what is eliminated can make them. All is done by blocks of
// four; what they reach beyond that is zero.
void BandedLu::take(std::shared_ptr<const BandOrder> order) {
  order_ = std::move(order);
  half_bandwidth_ = order_->half_bandwidth;
  const int n = static_cast<int>(order_->unknown.size());
  padded_ = (n + block - 1) / block * block;
  const auto padded = static_cast<std::size_t>(padded_);
  // The last row that the elimination of a column reaches; the end of the longest of the rows up to one.
  const auto below = [&](int k) { return k < n ? order_->below[k] : k; };
  std::vector<int> longest = order_->ends;
  for (int i = 1; i < n; ++i) longest[i] = std::max(longest[i], longest[i - 1]);
  row_begin_.resize(padded + 1);
  diagonal_.resize(padded);
  lower_begin_.resize(padded + 1);
  row_begin_[0] = lower_begin_[0] = 0;
  for (int i = 0, first = 0; i < padded_; ++i) {
    while (first < i && below(first) < i) ++first;
    const int last = std::min(i / block * block + block, n) - 1, reach = below(last);
    const int end = std::max(i + 1, longest[reach]);
    diagonal_[i] = row_begin_[i] + i - first;
    row_begin_[i + 1] = row_begin_[i] + (end - first) + 2 * block;
    lower_begin_[i + 1] = lower_begin_[i] + std::max(reach, i) - i + 2 * block;
  }
  band_ = std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(row_begin_.back()));
  lower_.assign(static_cast<std::size_t>(lower_begin_.back()), 0);
  scale_.resize(order_->unknown.size());
  pivots_.resize(padded);
  reach_.resize(padded / block);
  inverse_.resize(padded);
  blocks_.resize(padded / block);
  room_ = padded + static_cast<std::size_t>(2 * half_bandwidth_ + 2 * block);
}

void BandedLu::fill_band(const Matrix& matrix) {
  const int n = static_cast<int>(order_->unknown.size());
  const double* values = matrix.valuePtr();
  std::fill_n(band_.get(), row_begin_.back(), 0.0);
  for (int i = 0; i < n; ++i) {
    double* entries = diagonal(i) - i;
    const auto first = order_->entries.begin() + order_->row_starts[i],
               last = order_->entries.begin() + order_->row_starts[i + 1];
    double largest = 0;
    for (auto entry = first; entry != last; ++entry)
      largest = std::max(largest, std::abs(values[entry->value]));
    const double scale = scale_[i] = largest > 0 ? 1 / largest : 1;
    for (auto entry = first; entry != last; ++entry) entries[entry->column] = scale * values[entry->value];
  }
  ends_ = order_->ends;
  for (int i = n; i < padded_; ++i) {
    *diagonal(i) = 1;
    ends_.push_back(i + 1);
  }
}

// The row, down to `last`, that takes the place: the one that is there if it is not much less than the
// largest, since every exchange widens the band.
NURBEAM_WITHIN int BandedLu::pivot_of(int column, int last) const {
  constexpr double enough = 0.1;
  const auto size = [&](int i) { return std::abs(diagonal(i)[column - i]); };
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
NURBEAM_WITHIN void BandedLu::exchange(int k, int p) {
  const int end = std::max(ends_[k], ends_[p]);
  std::swap_ranges(diagonal(k), diagonal(k) + end - k, diagonal(p) + k - p);
  std::swap(ends_[k], ends_[p]);
}

// Takes the unknown of a column out of the rows below, down to `last`.
NURBEAM_WITHIN void BandedLu::take_out(int k, int last) {
  const int length = ends_[k] - k;
  const double* upper = diagonal(k);
  double* multipliers = lower_.data() + lower_begin_[k];
  int& reach = reach_[k / block];
  for (int i = k + 1; i <= last; ++i) {
    double* below = diagonal(i) + k - i;
    const double factor = multipliers[i - k - 1] = below[0] * inverse_[k];
    if (factor == 0) continue;
    reach = std::max(reach, i);
    ends_[i] = std::max(ends_[i], ends_[k]);
    for (int j = 1; j < length; j += block) four(below + j) -= factor * four(upper + j);
  }
}

NURBEAM_WITHIN void BandedLu::invert_upper(int k) {
  std::array<const double*, block> u;  // from column k on
  for (int r = 0; r < block; ++r) u[r] = diagonal(k + r) - r;
  Square &inverse = blocks_[k / block].upper, &next = blocks_[k / block].from_next;
  for (int j = 0; j < block; ++j) {
    inverse[j] = {};
    inverse[j][j] = inverse_[k + j];
    for (int i = j - 1; i >= 0; --i) {
      double sum = 0;
      for (int l = i + 1; l <= j; ++l) sum += u[i][l] * inverse[j][l];
      inverse[j][i] = -inverse_[k + i] * sum;
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
  const std::array<const double*, block> m = multipliers(k);
  for (int j = 0; j < block; ++j) {
    own.lower[j] = {};
    own.lower[j][j] = 1;
    for (int i = j + 1; i < block; ++i)
      for (int l = j; l < i; ++l) own.lower[j][i] -= m[l][i - l - 1] * own.lower[j][l];
  }
  if (k == 0 || blocks_[k / block - 1].exchanged) return;
  const std::array<const double*, block> before = multipliers(k - block);
  for (int j = 0; j < block; ++j)
    four(own.from_previous[j].data()) = product(own.lower, four(before[j] + block - 1 - j));
}

NURBEAM_FOR_EVERY_PROCESSOR double BandedLu::eliminate_rows() {
  const int n = static_cast<int>(order_->unknown.size());
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (int k = 0; k < padded_; ++k) {
    const int last = k < n ? order_->below[k] : k, p = pivots_[k] = pivot_of(k, last);
    if (p != k) exchange(k, p);
    const double pivot = *diagonal(k);
    if (pivot == 0) return 0;
    inverse_[k] = 1 / pivot;
    if (k < n) {
      smallest = std::min(smallest, std::abs(pivot));
      largest = std::max(largest, std::abs(pivot));
    }
    if (k % block == 0) reach_[k / block] = 0;
    take_out(k, last);
    if (k % block == block - 1) {
      invert_upper(k - k % block);
      invert_lower(k - k % block);
    }
  }
  return largest > 0 ? smallest / largest : 0;
}

double BandedLu::factorise(const Matrix& matrix) {
  fill_band(matrix);
  return order_->unknown.empty() ? 1 : eliminate_rows();
}

NURBEAM_WITHIN std::array<const double*, block> BandedLu::multipliers(int k) const {
  std::array<const double*, block> m;
  for (int c = 0; c < block; ++c) m[c] = lower_.data() + lower_begin_[k + c];
  return m;
}

// Takes a block of unknowns whose rows stay out of the right-hand sides below it, from the `first` one on.
NURBEAM_WITHIN void BandedLu::take_out(int k, const Four& x, int first, double* y) const {
  const std::array<const double*, block> m = multipliers(k);
  for (int i = first; k + block + i <= reach_[k / block]; i += block)
    four(y + block + i) -= four(m[0] + i + 3) * x[0] + four(m[1] + i + 2) * x[1] + four(m[2] + i + 1) * x[2] +
                           four(m[3] + i) * x[3];
}

// Finds a block of unknowns and takes it out of the right-hand sides below it.
NURBEAM_WITHIN void BandedLu::eliminate(int k, double* all) const {
  double* y = all + k;
  if (!blocks_[k / block].exchanged) {
    const Four x = product(blocks_[k / block].lower, four(y));
    four(y) = x;
    return take_out(k, x, 0, y);
  }
  const std::array<const double*, block> m = multipliers(k);
  for (int c = 0; c < block; ++c) {
    std::swap(y[c], all[pivots_[k + c]]);
    for (int i = 0; k + c + 1 + i <= reach_[k / block]; ++i) y[c + 1 + i] -= m[c][i] * y[c];
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
        const std::array<const double*, block> m = multipliers(k - block);
        for (int c = 0; c < block; ++c) four(y) -= four(m[c] + block - 1 - c) * before[c];
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
    last = std::max({last, reach_[k / block], *std::max_element(&pivots_[k], &pivots_[k] + block)});
  }
}

// Block by block from those after it, of which the next one comes in last: it is waited for.
NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::upper(Places& all) const {
  Four after = {};
  for (int k = padded_ - block; k >= 0; k -= block) {
    std::array<const double*, block> u;  // from column k on
    for (int r = 0; r < block; ++r) u[r] = diagonal(k + r) - r;
    double* y = all.data() + k;
    const int length = *std::max_element(&ends_[k], &ends_[k] + block) - k;
    Four sums[block] = {};
    for (int j = 2 * block; j < length; j += block)
      for (int r = 0; r < block; ++r) sums[r] += four(u[r] + j) * four(y + j);
    const Four rest = four(y) - Four{sum_of(sums[0]), sum_of(sums[1]), sum_of(sums[2]), sum_of(sums[3])};
    after = product(blocks_[k / block].upper, rest) - product(blocks_[k / block].from_next, after);
    four(y) = after;
  }
}

NURBEAM_FOR_EVERY_PROCESSOR void BandedLu::upper_transposed(Places& y, int first, int& last) const {
  for (int k = first; k <= last; ++k) {
    if (y[k] == 0) continue;
    y[k] *= inverse_[k];
    const double* u = diagonal(k);
    for (int i = 1; i < ends_[k] - k; ++i) y[k + i] -= u[i] * y[k];
    last = std::max(last, ends_[k] - 1);
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
    const double* multipliers = lower_.data() + lower_begin_[k] - k - 1;
    const int last = order_->below[k];
    for (int i = k + 1; i <= last; ++i)
      for (int c = 0; c < times; ++c) at(i)[c] -= multipliers[i] * x[c];
  }
  for (int k = n - 1; k >= 0; --k) {
    const double* upper = diagonal(k) - k;
    Four* own = at(k);
    for (int c = 0; c < times; ++c) x[c] = own[c];
    const int end = ends_[k];
    for (int j = k + 1; j < end; ++j)
      for (int c = 0; c < times; ++c) x[c] -= upper[j] * at(j)[c];
    for (int c = 0; c < times; ++c) own[c] = inverse_[k] * x[c];
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
