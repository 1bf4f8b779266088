#include "solver/algebra/band_order.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "solver/algebra/close_order.h"

namespace nurbeam {

namespace {

// The unknowns with which each unknown is coupled: itself too, by the rows of its column alone.
class Neighbours {
 public:
  Neighbours(const SparseView& pattern, const std::vector<int>& left_out)
      : pattern_(pattern), coupled_(static_cast<std::size_t>(pattern.cols()), false) {
    for (const int i : left_out)
      for (const int* other = begin(i); other != end(i); ++other) coupled_[*other] = true;
  }

  int size() const { return static_cast<int>(pattern_.cols()); }
  int count(int i) const { return pattern_.outerIndexPtr()[i + 1] - pattern_.outerIndexPtr()[i]; }
  const int* begin(int i) const { return pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[i]; }
  const int* end(int i) const { return begin(i) + count(i); }
  /// Whether the unknown is coupled with those left out.
  bool is_coupled(int i) const { return coupled_[i]; }

 private:
  const SparseView& pattern_;
  std::vector<bool> coupled_;
};

// The last walk in which each unknown was seen; unknowns left out are in none.
struct Walks {
  static constexpr int never = std::numeric_limits<int>::max();
  std::vector<int> last;
  int number = 0;
};

// Appends the component of `start`, by levels. In each level unknowns coupled with those left out come first,
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
    // Insertion sort, as a level has few unknowns.
    for (std::size_t i = first_new; i < order.size(); ++i)
      std::rotate(std::upper_bound(order.begin() + static_cast<std::ptrdiff_t>(first_new),
                                   order.begin() + static_cast<std::ptrdiff_t>(i), order[i], fewer),
                  order.begin() + static_cast<std::ptrdiff_t>(i),
                  order.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
  return levels;
}

// The component of `start`, by levels from an unknown at one of its ends, where the number of levels is the
// largest that is easily found. The start is an unknown coupled with those left out, if the number is nearly
// as large from there.
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

BandOrder::BandOrder(const SparseView& pattern, const std::vector<int>& left_out) {
  std::optional<std::vector<int>> close = close_order(pattern, left_out);
  unknown = close ? std::move(*close) : by_levels(Neighbours(pattern, left_out), left_out);
  place_unknowns(pattern);
}

BandOrder BandOrder::of(const SparseView& pattern, std::vector<int> unknowns) {
  BandOrder order;
  order.unknown = std::move(unknowns);
  order.place_unknowns(pattern);
  return order;
}

BandOrder BandOrder::aligned(int block) const {
  const int held = static_cast<int>(unknown.size());
  std::vector<int> moved(unknown.size());  // new places
  int next = 0;
  for (int first = 0, last = 0; first < held; first = last) {
    while (last < held && ends[last] == ends[first]) ++last;
    if ((last - first) % block == 0) next = (next + block - 1) / block * block;
    for (int k = first; k < last; ++k) moved[k] = next++;
  }
  if (next == held) return *this;
  BandOrder order;
  order.unknown.assign(static_cast<std::size_t>(next), -1);
  order.place.assign(place.size(), -1);
  order.ends.resize(static_cast<std::size_t>(next));
  std::iota(order.ends.begin(), order.ends.end(), 1);
  order.below.assign(static_cast<std::size_t>(next), 0);
  for (int k = 0; k < held; ++k) {
    order.unknown[moved[k]] = unknown[k];
    order.place[unknown[k]] = moved[k];
    order.ends[moved[k]] = moved[ends[k] - 1] + 1;
    order.below[moved[k]] = moved[below[k]];
  }
  for (int k = 0; k < next; ++k) {
    if (order.unknown[k] < 0) order.below[k] = std::max(k, k > 0 ? order.below[k - 1] : 0);
    order.half_bandwidth = std::max({order.half_bandwidth, order.ends[k] - 1 - k, order.below[k] - k});
  }
  return order;
}

// Sets all members that follow from `unknown`.
void BandOrder::place_unknowns(const SparseView& pattern) {
  place.assign(static_cast<std::size_t>(pattern.cols()), -1);
  const int held = static_cast<int>(unknown.size());
  for (int k = 0; k < held; ++k) place[unknown[k]] = k;
  ends.resize(unknown.size());
  std::iota(ends.begin(), ends.end(), 1);
  below.assign(unknown.size(), 0);
  // Columns that follow one another with the same rows, as those of a node, are visited once.
  for (int first = 0, end = 0; first < held; first = end) {
    for (end = first + 1; end < held && have_same_rows(pattern, unknown[first], unknown[end]);) ++end;
    int highest = first, lowest = first > 0 ? below[first - 1] : 0;
    for (int k = pattern.outerIndexPtr()[unknown[first]]; k < pattern.outerIndexPtr()[unknown[first] + 1];
         ++k) {
      const int row = place[pattern.innerIndexPtr()[k]];
      if (row < 0) continue;
      ends[row] = std::max(ends[row], end);
      highest = std::min(highest, row);
      lowest = std::max(lowest, row);
      half_bandwidth = std::max(half_bandwidth, row - first);
    }
    half_bandwidth = std::max(half_bandwidth, end - 1 - highest);
    std::fill(below.begin() + first, below.begin() + end, lowest);
  }
}

}  // namespace nurbeam
