#include "solver/algebra/close_order.h"

#include <algorithm>
#include <utility>

namespace nurbeam {

namespace {

class CloseOrder {
 public:
  CloseOrder(const SparseView& pattern, const std::vector<int>& left_out)
      : starts_(pattern.outerIndexPtr()),
        rows_(pattern.innerIndexPtr()),
        size_(static_cast<int>(pattern.cols())),
        kinds_(static_cast<std::size_t>(size_), Kind::stays) {
    for (const int i : left_out) kinds_[i] = Kind::left_out;
    for (int i = 0; i < size_; ++i) most_ = std::max(most_, starts_[i + 1] - starts_[i]);
    find_moved();
    put_together();
    find_reaches();
  }

  /// Whether the band is narrow. Half the bandwidth is at least half the largest number of couplings of one
  /// unknown; in a chain it is two thirds.
  bool is_narrow() const {
    int width = 0;
    for (int k = 0; k < static_cast<int>(unknowns_.size()); ++k)
      width = std::max({width, last_[k] - k, k - first_[k]});
    return 4 * width <= 3 * most_;
  }

  /// The order with components reversed where that is better. A component ends where no earlier place reaches
  /// further.
  std::vector<int> turned(const std::vector<int>& left_out) {
    std::vector<bool> is_coupled(static_cast<std::size_t>(size_), false);
    for (const int i : left_out)
      for (int k = starts_[i]; k < starts_[i + 1]; ++k) is_coupled[rows_[k]] = true;
    const int held = static_cast<int>(unknowns_.size());
    for (int begin = 0, end = 0, reach = 0; begin < held; begin = end) {
      int coupled = -1;
      for (; end < held && (end == begin || end <= reach); ++end) {
        reach = std::max(reach, last_[end]);
        if (coupled < 0 && is_coupled[unknowns_[end]]) coupled = end;
      }
      if (coupled >= 0 && coupled - begin < end - 1 - coupled)
        std::reverse(unknowns_.begin() + begin, unknowns_.begin() + end);
    }
    return std::move(unknowns_);
  }

 private:
  enum class Kind : char { stays, moved, left_out };

  void find_moved() {
    for (int i = 0; i < size_; ++i) {
      if (kinds_[i] == Kind::left_out) continue;
      const int* other = rows_ + starts_[i];
      const int* const end = rows_ + starts_[i + 1];
      while (other != end && kinds_[*other] == Kind::left_out) ++other;
      if (other == end || i - *other <= most_) continue;
      moved_.emplace_back(*other, i);
      kinds_[i] = Kind::moved;
    }
    std::sort(moved_.begin(), moved_.end());
  }

  void put_together() {
    unknowns_.reserve(static_cast<std::size_t>(size_));
    auto next = moved_.begin();
    for (int i = 0; i < size_; ++i) {
      if (kinds_[i] == Kind::stays) unknowns_.push_back(i);
      for (; next != moved_.end() && next->first == i; ++next) unknowns_.push_back(next->second);
    }
  }

  // Finds the first and the last place with which each place is coupled. Unknowns that stay are in order, and
  // so are the rows of a column.
  void find_reaches() {
    const int held = static_cast<int>(unknowns_.size());
    std::vector<int> place(static_cast<std::size_t>(size_), -1);
    for (int k = 0; k < held; ++k) place[unknowns_[k]] = k;
    first_.resize(unknowns_.size());
    last_.resize(unknowns_.size());
    for (int k = 0; k < held; ++k) {
      const int *begin = rows_ + starts_[unknowns_[k]], *end = rows_ + starts_[unknowns_[k] + 1];
      while (begin != end && kinds_[*begin] != Kind::stays) ++begin;
      while (begin != end && kinds_[end[-1]] != Kind::stays) --end;
      first_[k] = begin == end ? k : std::min(k, place[*begin]);
      last_[k] = begin == end ? k : std::max(k, place[end[-1]]);
    }
    for (const auto& moved : moved_) {
      const int k = place[moved.second];
      for (int i = starts_[moved.second]; i < starts_[moved.second + 1]; ++i)
        if (const int other = place[rows_[i]]; other >= 0) {
          first_[k] = std::min(first_[k], other);
          last_[k] = std::max(last_[k], other);
          last_[other] = std::max(last_[other], k);
        }
    }
  }

  const int *starts_, *rows_;
  int size_, most_ = 0;
  std::vector<Kind> kinds_;
  std::vector<std::pair<int, int>> moved_;  // pairs of an unknown and the one moved behind it
  std::vector<int> unknowns_, first_, last_;
};

}  // namespace

std::optional<std::vector<int>> close_order(const SparseView& pattern, const std::vector<int>& left_out) {
  CloseOrder order(pattern, left_out);
  if (!order.is_narrow()) return std::nullopt;
  return order.turned(left_out);
}

}  // namespace nurbeam
