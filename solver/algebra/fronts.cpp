#include "solver/algebra/fronts.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <type_traits>

namespace nurbeam {

namespace {

// Disjoint sets of places, each led by one of them.
class Groups {
 public:
  explicit Groups(int places) : next_(static_cast<std::size_t>(places)) {
    std::iota(next_.begin(), next_.end(), 0);
  }
  int leader(int place) {
    while (next_[place] != place) place = next_[place] = next_[next_[place]];
    return place;
  }
  void unite(int one, int other) {
    one = leader(one);
    other = leader(other);
    next_[std::max(one, other)] = std::min(one, other);
  }

 private:
  std::vector<int> next_;
};

// Groups of unknowns that are eliminated together in each level, from outside in.
class Grouping {
 public:
  Grouping(const SparsePattern& pattern, const CouplingLevels& levels)
      : pattern_(pattern),
        levels_(levels),
        groups_(static_cast<int>(levels.unknowns.size())),
        before_(levels.unknowns.size(), -1),
        place_(static_cast<std::size_t>(pattern.size()), -1) {
    for (int k = 0; k < static_cast<int>(levels.unknowns.size()); ++k) place_[levels.unknowns[k]] = k;
    for (int level = levels.count() - 1; level >= 0; --level) unite_level(level);
  }

  /// The leader of the group of a place in the levels.
  int leader(int place) { return groups_.leader(place); }
  /// A place of the level before that is coupled with a group, given by its leader; -1: none.
  int before(int leader) const { return before_[leader]; }

 private:
  void unite_level(int level) {
    const int begin = levels_.starts[level], end = levels_.starts[level + 1];
    for (int k = begin; k < end; ++k) {
      if (k > begin && is_like_previous(k)) {
        groups_.unite(k - 1, k);
        continue;
      }
      for_each_coupled(k, [&](int place) {
        if (place >= begin && place < end) groups_.unite(place, k);
      });
    }
    const int outer = level > 0 ? levels_.starts[level - 1] : begin;
    for (int k = begin; k < end; ++k) {
      if (k > begin && is_like_previous(k)) continue;
      int& of_group = before_[groups_.leader(k)];
      for_each_coupled(k, [&](int place) {
        if (place < outer || place >= begin) return;
        if (of_group >= 0)
          groups_.unite(place, of_group);
        else
          of_group = place;
      });
    }
  }
  bool is_like_previous(int k) const {
    return coupled_alike(pattern_, levels_.unknowns[k - 1], levels_.unknowns[k]);
  }
  template <class Visit>
  void for_each_coupled(int k, const Visit& visit) const {
    const int column = levels_.unknowns[k];
    for (int e = pattern_.column_starts()[column]; e < pattern_.column_starts()[column + 1]; ++e)
      if (const int place = place_[pattern_.rows()[e]]; place >= 0) visit(place);
  }

  const SparsePattern& pattern_;
  const CouplingLevels& levels_;
  Groups groups_;
  std::vector<int> before_, place_;  // per unknown, -1: none
};

template <int N>
using Vector = Eigen::Map<Eigen::Matrix<double, N, 1>>;
template <int N>
using ConstVector = Eigen::Map<const Eigen::Matrix<double, N, 1>>;
template <int N>
using Square = Eigen::Map<Eigen::Matrix<double, N, N, Eigen::RowMajor>>;

// Calls work with the number of unknowns of a front as a constant, if it is that of strands in the plane or
// in space, else as Eigen::Dynamic.
template <class Work>
auto with_size(const Front& front, const Work& work) {
  if (front.own == 4 && front.before == 4) return work.template operator()<4>();
  if (front.own == 6 && front.before == 6) return work.template operator()<6>();
  return work.template operator()<Eigen::Dynamic>();
}

// The blocks of a front.
template <int N, class Number>
struct Blocks {
  using Plain = Eigen::Matrix<double, N, N, Eigen::RowMajor>;
  using Block = Eigen::Map<std::conditional_t<std::is_const_v<Number>, const Plain, Plain>>;

  Block own, upper, lower;

  Blocks(const Front& front, Number* blocks)
      : own(blocks + front.blocks, front.own, front.own),
        upper(blocks + front.upper(), front.own, front.before),
        lower(blocks + front.lower(), front.before, front.own) {}
};

// Calls add(rows, block, x) for each block of a front, with the parts of both vectors that it couples.
template <class Add>
void for_each_block(const Front& front, const double* blocks, const double* x, double* rows, const Add& add) {
  with_size(
      front,
      [&]<int N>() {
        const Blocks<N, const double> of(front, blocks);
        const ConstVector<N> own(x + front.first, front.own), before(x + front.first_before, front.before);
        Vector<N> rows_own(rows + front.first, front.own),
            rows_before(rows + front.first_before, front.before);
        add(rows_own, of.own, own);
        add(rows_own, of.upper, before);
        add(rows_before, of.lower, own);
      });
}

}  // namespace

Fronts::Fronts(const SparsePattern& pattern, const CouplingLevels& levels)
    : unknowns_(levels.unknowns), starts_(levels.starts), front_of_(levels.unknowns.size()) {
  Grouping grouping(pattern, levels);
  const int count = static_cast<int>(unknowns_.size());
  std::vector<int> leaders(unknowns_.size()), front_led(unknowns_.size(), -1), places(unknowns_.size());
  for (int k = 0; k < count; ++k) leaders[k] = grouping.leader(k);
  std::iota(places.begin(), places.end(), 0);
  int blocks = 0;
  for (int level = 0; level < level_count(); ++level) {
    first_front_.push_back(static_cast<int>(fronts_.size()));
    const auto begin = places.begin() + start(level), end = places.begin() + start(level + 1);
    std::sort(begin, end, [&](int one, int other) {
      return leaders[one] != leaders[other] ? leaders[one] < leaders[other] : one < other;
    });
    for (int k = start(level); k < start(level + 1); ++k) {
      const int place = places[k], leader = leaders[place];
      unknowns_[k] = levels.unknowns[place];
      if (front_led[leader] < 0) {
        front_led[leader] = static_cast<int>(fronts_.size());
        const int before = grouping.before(leader), parent = before < 0 ? -1 : front_led[leaders[before]];
        fronts_.push_back(
            {k, 0, parent < 0 ? k : fronts_[parent].first, parent < 0 ? 0 : fronts_[parent].own, parent, 0});
      }
      front_of_[k] = front_led[leader];
      ++fronts_[front_of_[k]].own;
    }
  }
  first_front_.push_back(static_cast<int>(fronts_.size()));
  for (Front& front : fronts_) {
    front.blocks = blocks;
    blocks = front.end();
  }
}

int Fronts::index(int row, int column) const {
  const Front &of_row = fronts_[front_of_[row]], &of_column = fronts_[front_of_[column]];
  const int i = row - of_row.first, j = column - of_column.first;
  if (front_of_[row] == front_of_[column]) return of_row.blocks + i * of_row.own + j;
  if (of_row.parent == front_of_[column]) return of_row.upper() + i * of_row.before + j;
  if (of_column.parent == front_of_[row]) return of_column.lower() + i * of_column.own + j;
  return -1;
}

void subtract_product(const Front& front, const double* blocks, const double* x, double* rows) {
  for_each_block(
      front, blocks, x, rows,
      [](auto& to, const auto& block, const auto& of) { to.noalias() -= block.lazyProduct(of); });
}

void add_absolute_product(const Front& front, const double* blocks, const double* x, double* rows) {
  for_each_block(
      front, blocks, x, rows,
      [](auto& to, const auto& block, const auto& of) { to += block.cwiseAbs().lazyProduct(of.cwiseAbs()); });
}

bool factorise(const Front& front, double* blocks) {
  return with_size(
      front,
      [&]<int N>() {
        Blocks<N, double> of(front, blocks);
        const int own = N == Eigen::Dynamic ? front.own : N, before = N == Eigen::Dynamic ? front.before : N;
        for (int p = 0; p < own; ++p) {
          if (!std::isfinite(of.own(p, p)) || of.own(p, p) == 0) return false;
          const double inverse = of.own(p, p) = 1 / of.own(p, p);
          for (int i = p + 1; i < own; ++i) {
            const double factor = of.own(i, p) *= inverse;
            for (int j = p + 1; j < own; ++j) of.own(i, j) -= factor * of.own(p, j);
            for (int j = 0; j < before; ++j) of.upper(i, j) -= factor * of.upper(p, j);
          }
        }
        for (int i = 0; i < before; ++i)
          for (int p = 0; p < own; ++p) {
            const double factor = of.lower(i, p) *= of.own(p, p);
            for (int j = p + 1; j < own; ++j) of.lower(i, j) -= factor * of.own(p, j);
          }
        return true;
      });
}

void take_from_parent(const Front& front, const Front& parent, double* blocks) {
  with_size(
      front,
      [&]<int N>() {
        const Blocks<N, const double> of(front, blocks);
        Square<N>(blocks + parent.blocks, parent.own, parent.own).noalias() -= of.lower.lazyProduct(of.upper);
      });
}

void solve_inwards(const Front& front, const double* blocks, double* x) {
  with_size(
      front,
      [&]<int N>() {
        const Blocks<N, const double> of(front, blocks);
        const int own = N == Eigen::Dynamic ? front.own : N;
        double* const of_own = x + front.first;
        for (int p = 0; p < own; ++p)
          for (int i = p + 1; i < own; ++i) of_own[i] -= of.own(i, p) * of_own[p];
        Vector<N>(x + front.first_before, front.before).noalias() -=
            of.lower.lazyProduct(ConstVector<N>(of_own, front.own));
      });
}

void solve_outwards(const Front& front, const double* blocks, double* x) {
  with_size(
      front,
      [&]<int N>() {
        const Blocks<N, const double> of(front, blocks);
        const int own = N == Eigen::Dynamic ? front.own : N;
        double* const of_own = x + front.first;
        Vector<N>(of_own, front.own).noalias() -=
            of.upper.lazyProduct(ConstVector<N>(x + front.first_before, front.before));
        for (int i = own - 1; i >= 0; --i) {
          for (int j = i + 1; j < own; ++j) of_own[i] -= of.own(i, j) * of_own[j];
          of_own[i] *= of.own(i, i);
        }
      });
}

}  // namespace nurbeam
