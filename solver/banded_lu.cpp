#include "solver/banded_lu.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Numbers = Eigen::Map<const Eigen::VectorXd>;
// The unknowns that each is coupled with: itself too, and the rows of its column alone.
class Neighbours {
 public:
  explicit Neighbours(const Matrix& pattern) : pattern_(pattern) {}

  int size() const { return static_cast<int>(pattern_.cols()); }
  int count(int i) const { return pattern_.outerIndexPtr()[i + 1] - pattern_.outerIndexPtr()[i]; }
  const int* begin(int i) const { return pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[i]; }
  const int* end(int i) const { return begin(i) + count(i); }

 private:
  const Matrix& pattern_;
};

// Which unknowns have been seen, and in which walk last.
struct Walks {
  std::vector<int> last;
  int number = 0;
};

// Appends the component of `start`, by levels, in each those with the fewest neighbours first. Returns the
// number of levels.
int append_by_levels(const Neighbours& neighbours, int start, Walks& walks, std::vector<int>& order) {
  const auto fewer = [&](int a, int b) { return neighbours.count(a) < neighbours.count(b); };
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
    const auto first_new = static_cast<std::ptrdiff_t>(order.size());
    for (const int* other = neighbours.begin(order[next]); other != neighbours.end(order[next]); ++other)
      if (walks.last[*other] != walks.number) append(*other);
    std::stable_sort(order.begin() + first_new, order.end(), fewer);
  }
  return levels;
}

// An unknown at an end of the component of `start`: from it the levels are the most that are easily found.
int end_of_component(const Neighbours& neighbours, int start, Walks& walks) {
  std::vector<int> order;
  for (int levels = 0;;) {
    order.clear();
    const int found = append_by_levels(neighbours, start, walks, order);
    if (found <= levels) return start;
    levels = found;
    start = order.back();
  }
}

}  // namespace

void BandedLu::analyse(const Matrix& pattern) {
  const Neighbours neighbours(pattern);
  const int n = neighbours.size();
  Walks walks{std::vector<int>(static_cast<std::size_t>(n), 0)};
  unknown_.clear();
  for (int i = 0; i < n; ++i)
    if (walks.last[i] == 0)
      append_by_levels(neighbours, end_of_component(neighbours, i, walks), walks, unknown_);
  std::reverse(unknown_.begin(), unknown_.end());
  place_.resize(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) place_[unknown_[k]] = k;
  half_bandwidth_ = 0;
  for (int i = 0; i < n; ++i)
    for (const int* j = neighbours.begin(i); j != neighbours.end(i); ++j)
      half_bandwidth_ = std::max(half_bandwidth_, std::abs(place_[i] - place_[*j]));
  width_ = 3 * half_bandwidth_ + 1;
}

void BandedLu::fill_band(const Matrix& matrix) {
  const auto n = unknown_.size();
  scale_.assign(n, 0);
  for (int column = 0; column < matrix.cols(); ++column)
    for (Matrix::InnerIterator entry(matrix, column); entry; ++entry)
      scale_[place_[entry.row()]] = std::max(scale_[place_[entry.row()]], std::abs(entry.value()));
  for (double& scale : scale_) scale = scale > 0 ? 1 / scale : 1;
  band_.assign(n * static_cast<std::size_t>(width_), 0);
  ends_.assign(n, 0);
  for (int column = 0; column < matrix.cols(); ++column)
    for (Matrix::InnerIterator entry(matrix, column); entry; ++entry) {
      const int i = place_[entry.row()], j = place_[column];
      row(i)[j - i + half_bandwidth_] = scale_[i] * entry.value();
      ends_[i] = std::max(ends_[i], j + 1);
    }
  lower_.assign(n * static_cast<std::size_t>(half_bandwidth_), 0);
  pivots_.resize(n);
  y_.resize(n);
}

int BandedLu::pivot_of(int column) const {
  const int n = static_cast<int>(unknown_.size()), last = std::min(n - 1, column + half_bandwidth_);
  int pivot = column;
  double largest = 0;
  for (int i = column; i <= last; ++i) {
    const double size = std::abs(row(i)[column - i + half_bandwidth_]);
    if (size > largest) {
      largest = size;
      pivot = i;
    }
  }
  return pivot;
}

double BandedLu::factorise(const Matrix& matrix) {
  fill_band(matrix);
  const int n = static_cast<int>(unknown_.size()), b = half_bandwidth_;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (int k = 0; k < n; ++k) {
    const int p = pivots_[k] = pivot_of(k);
    if (p != k) {
      const int end = std::max(ends_[k], ends_[p]);
      std::swap_ranges(row(k) + b, row(k) + b + end - k, row(p) + k - p + b);
      std::swap(ends_[k], ends_[p]);
    }
    const double* upper = row(k) + b;
    const double pivot = upper[0];
    smallest = std::min(smallest, std::abs(pivot));
    largest = std::max(largest, std::abs(pivot));
    if (pivot == 0) return 0;
    double* multipliers = lower_.data() + static_cast<std::size_t>(k) * b;
    const int length = ends_[k] - k, last = std::min(n - 1, k + b);
    for (int i = k + 1; i <= last; ++i) {
      double* below = row(i) + k - i + b;
      if (below[0] == 0) continue;
      const double factor = multipliers[i - k - 1] = below[0] / pivot;
      for (int j = 1; j < length; ++j) below[j] -= factor * upper[j];
      ends_[i] = std::max(ends_[i], ends_[k]);
    }
  }
  return largest > 0 ? smallest / largest : 0;
}

void BandedLu::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const {
  const int n = static_cast<int>(unknown_.size()), b = half_bandwidth_;
  for (int k = 0; k < n; ++k) y_[k] = scale_[k] * rhs[unknown_[k]];
  for (int k = 0; k < n; ++k) {
    std::swap(y_[k], y_[pivots_[k]]);
    const double value = y_[k];
    if (value == 0) continue;
    const double* multipliers = lower_.data() + static_cast<std::size_t>(k) * b;
    const int count = std::min(n - 1 - k, b);
    for (int i = 0; i < count; ++i) y_[k + 1 + i] -= multipliers[i] * value;
  }
  x.resize(n);
  for (int k = n - 1; k >= 0; --k) {
    const double* upper = row(k) + b;
    const int count = ends_[k] - k - 1;
    y_[k] = (y_[k] - Numbers(upper + 1, count).dot(Numbers(&y_[k] + 1, count))) / upper[0];
    x[unknown_[k]] = y_[k];
  }
}

}  // namespace nurbeam
