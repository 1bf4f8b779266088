// Positions of the entries of an assembly's tangents.
#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>
#include <utility>

#include "fem/system/assembly.h"
#include "fem/system/coupling.h"

namespace nurbeam {

namespace {

// Indices of the entries of a sparse matrix among its values.
struct SparsePlaces {
  const SparsePattern& of;

  int start(int column) const { return of.column_starts()[column]; }
  /// `guess`: possible distance of the entry from the start of its column.
  int operator()(int row, int column, int guess) const {
    const int* const all = of.rows().data();
    const int begin = start(column), end = start(column + 1);
    if (guess < end - begin && all[begin + guess] == row) return begin + guess;
    return static_cast<int>(std::lower_bound(all + begin, all + end, row) - all);
  }
};

// Indices of the entries of the dense matrix of some unknowns, in order.
struct DensePlaces {
  const std::vector<int>& unknowns;

  int place(int unknown) const {
    return static_cast<int>(std::lower_bound(unknowns.begin(), unknowns.end(), unknown) - unknowns.begin());
  }
  int start(int column) const { return place(column) * static_cast<int>(unknowns.size()); }
  int operator()(int row, int column, int) const { return start(column) + place(row); }
};

// The coordinates of a bound force in its own block; empty where it has none.
template <class Force>
std::vector<int> own_dofs(const Force& force) {
  if constexpr (requires { force.dofs(); })
    return force.dofs();
  else
    return {};
}

}  // namespace

template <int D>
void Assembly<D>::list_blocks() {
  for (const BoundForce<D>& force : forces_)
    force_blocks_.push_back({std::visit([](const auto& f) { return own_dofs(f); }, force), {}});
}

// Whether two assemblies couple the same coordinates, and the same of them move.
template <int D>
bool Assembly<D>::couples_as(const Assembly& other) const {
  const auto same_dofs = [](const std::vector<Block>& blocks, const std::vector<Block>& others) {
    return std::equal(
        blocks.begin(), blocks.end(), others.begin(), others.end(),
        [](const Block& a, const Block& b) { return a.dofs == b.dofs; });
  };
  const auto same_elements = [](const MeshElement<D>& a, const MeshElement<D>& b) {
    return a.dofs == b.dofs && !a.twist == !b.twist && (!a.twist || a.twist->dofs == b.twist->dofs);
  };
  return mesh_.coordinate_count == other.mesh_.coordinate_count &&
         std::equal(elements_.begin(), elements_.end(), other.elements_.begin(), other.elements_.end(),
                    same_elements) &&
         same_dofs(force_blocks_, other.force_blocks_) && over_mesh_ == other.over_mesh_ &&
         std::equal(constraint_blocks_.begin(), constraint_blocks_.end(), other.constraint_blocks_.begin(),
                    other.constraint_blocks_.end(),
                    [](const ConstraintBlock& a, const ConstraintBlock& b) {
                      return a.row == b.row && a.rows == b.rows && a.block.dofs == b.block.dofs;
                    }) &&
         std::equal(constraints_.begin(), constraints_.end(), other.constraints_.begin(),
                    [](const auto& a, const auto& b) { return a.index() == b.index(); });
}

template <int D>
void Assembly<D>::take_pattern(const Assembly& other) {
  element_runs_ = other.element_runs_;
  twist_runs_ = other.twist_runs_;
  force_blocks_ = other.force_blocks_;
  constraint_blocks_ = other.constraint_blocks_;
  moving_ = other.moving_;
  pattern_ = other.pattern_;
}

template <int D>
void Assembly<D>::build_pattern() {
  const CoupledGroups groups = coupled_groups();
  Coupling coupling(groups.unknowns);
  const auto couple = [&](const auto& dofs) {
    coupling.add(dofs);
    coupling.close();
  };
  for (const std::span<const int> element : groups.elements) couple(element);
  for (const std::vector<int>& other : groups.others) couple(other);
  pattern_ = coupling.pattern();

  std::vector<int> all(elements_.size());
  std::iota(all.begin(), all.end(), 0);
  locate_elements(all, SparsePlaces{pattern_}, element_runs_, twist_runs_);
  element_runs_.runs.shrink_to_fit();
  locate_blocks();
}

template <int D>
CoupledGroups Assembly<D>::coupled_groups() const {
  const int n = mesh_.coordinate_count;
  CoupledGroups groups{n + constraint_count_, {}, {}};
  groups.elements.reserve(elements_.size());
  for (const MeshElement<D>& e : elements_)
    groups.elements.push_back(e.twist ? std::span<const int>(e.twist->dofs) : std::span<const int>(e.dofs));
  for (const Block& force : force_blocks_) groups.others.push_back(force.dofs);
  for (const ConstraintBlock& constraint : constraint_blocks_) {
    groups.others.push_back(constraint.block.dofs);
    for (int r = 0; r < constraint.rows; ++r) groups.others.back().push_back(n + constraint.row + r);
  }
  return groups;
}

// Takes over the pattern and the runs of another system of the model, shifted, and renews one stretch.
// Returns whether all else is equal.
template <int D>
bool Assembly<D>::shift_pattern(const Assembly& other) {
  const CoupledGroups old = other.coupled_groups(), now = coupled_groups();
  const std::optional<PatternShift> shift = PatternShift::between(old, now);
  if (!shift) return false;
  pattern_ = shift->pattern(other.pattern_, now);
  const int old_end = static_cast<int>(other.elements_.size());
  std::vector<int> renewed(elements_.size() - static_cast<std::size_t>(shift->left()) -
                           static_cast<std::size_t>(shift->right()));
  std::iota(renewed.begin(), renewed.end(), shift->left());
  element_runs_.append(other.element_runs_, 0, shift->left(), 0);
  twist_runs_.append(other.twist_runs_, 0, shift->left(), 0);
  locate_elements(renewed, SparsePlaces{pattern_}, element_runs_, twist_runs_);
  const int by = shift->entries_by(other.pattern_, pattern_);
  element_runs_.append(other.element_runs_, old_end - shift->right(), old_end, by);
  twist_runs_.append(other.twist_runs_, old_end - shift->right(), old_end, by);
  locate_blocks();
  return true;
}

template <int D>
void Assembly<D>::locate_blocks() {
  const SparsePlaces index_of{pattern_};
  for (Block& block : force_blocks_) locate(block.dofs, index_of, block.runs);
  for (ConstraintBlock& block : constraint_blocks_) locate(block, index_of);
}

// Adds the runs of the entries of a contribution; `index_of` gives the index for a row and a column. Rows
// that follow one another also do so in the matrix, which has all of them. In the columns of one node they
// lie equally far from the start.
template <int D>
template <class IndexOf>
void Assembly<D>::locate(std::span<const int> dofs, const IndexOf& index_of, std::vector<Run>& runs) {
  struct Rows {
    int first;
    std::uint8_t at, count;
    int from_start;  // in the column before
    int run;         // last run of these rows, -1: none
  };
  constexpr std::size_t most = 64;  // coordinates of a contribution
  assert(dofs.size() <= most);
  std::array<Rows, most> in_column;
  std::size_t count = 0;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (dofs[i] < 0) continue;
    if (i > 0 && dofs[i - 1] >= 0 && dofs[i] == dofs[i - 1] + 1)
      ++in_column[count - 1].count;
    else
      in_column[count++] = {dofs[i], static_cast<std::uint8_t>(i), 1, 0, -1};
  }
  for (std::size_t j = 0; j < dofs.size(); ++j) {
    if (dofs[j] < 0) continue;
    const int start = index_of.start(dofs[j]);
    for (Rows& rows : std::span(in_column).first(count)) {
      const int value = index_of(rows.first, dofs[j], rows.from_start);
      rows.from_start = value - start;
      if (rows.run >= 0 && runs[rows.run].takes(static_cast<int>(j), value)) continue;
      rows.run = static_cast<int>(runs.size());
      runs.push_back({value, 0, static_cast<std::uint8_t>(j), 1, rows.at, rows.count});
    }
  }
}

// Locates the entries of these elements, in order.
template <int D>
template <class IndexOf>
void Assembly<D>::locate_elements(const std::vector<int>& elements, const IndexOf& index_of,
                                  ElementRuns& element_runs, ElementRuns& twist_runs) const {
  for (ElementRuns* each : {&element_runs, &twist_runs}) each->starts.reserve(elements.size() + 1);
  const auto add = [&](std::span<const int> dofs, ElementRuns& to) {
    locate(dofs, index_of, to.runs);
    to.starts.push_back(static_cast<int>(to.runs.size()));
  };
  for (const int i : elements) {
    add(elements_[i].dofs, element_runs);
    add(twist_dofs(i), twist_runs);
  }
}

template <int D>
template <class IndexOf>
void Assembly<D>::locate(ConstraintBlock& block, const IndexOf& index_of) const {
  const int n = mesh_.coordinate_count;
  block.block.runs.clear();
  locate(block.block.dofs, index_of, block.block.runs);
  block.gradient_values.clear();
  block.transposed_values.clear();
  for (int dof : block.block.dofs)
    for (int r = block.row; r < block.row + block.rows; ++r) {
      block.gradient_values.push_back(dof >= 0 ? index_of(n + r, dof, 0) : -1);
      block.transposed_values.push_back(dof >= 0 ? index_of(dof, n + r, 0) : -1);
    }
}

// Marks all unknowns of constraints that hold a marked unknown, again and again. The unmarked ones are then
// constrained among themselves.
template <int D>
void Assembly<D>::mark_constrained(std::vector<bool>& marked) const {
  const auto touches = [&](const ConstraintBlock& block) {
    return std::any_of(block.block.dofs.begin(), block.block.dofs.end(),
                       [&](int dof) { return dof >= 0 && marked[dof]; });
  };
  for (bool grows = true; std::exchange(grows, false);)
    for (const ConstraintBlock& block : constraint_blocks_) {
      const int first = mesh_.coordinate_count + block.row;
      if (marked[first] || !touches(block)) continue;
      grows = true;
      std::fill_n(marked.begin() + first, block.rows, true);
      for (const int dof : block.block.dofs)
        if (dof >= 0) marked[dof] = true;
    }
}

template <int D>
void Assembly<D>::choose_moving_part() {
  std::vector<bool> marked(static_cast<std::size_t>(mesh_.coordinate_count + constraint_count_), false);
  const auto mark = [&](std::span<const int> dofs) {
    for (const int dof : dofs)
      if (dof >= 0) marked[dof] = true;
  };
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i) {
    if (elements_[i].element.fixed()) continue;
    moving_.elements.push_back(i);
    mark(elements_[i].dofs);
    mark(twist_dofs(i));
  }
  for (const int i : over_mesh_) {
    if (std::visit([](const auto& c) { return offers_of<decltype(c)>.linear; }, constraints_[i])) continue;
    moving_.constraints.push_back(i);
    moving_.constraint_blocks.push_back(constraint_blocks_[i]);
    mark(constraint_blocks_[i].block.dofs);
  }
  mark_constrained(marked);
  std::vector<int>& unknowns = moving_.unknowns;
  for (int i = 0; i < static_cast<int>(marked.size()); ++i)
    if (marked[i]) unknowns.push_back(i);
  // The moving part is kept apart where it is a small share of all unknowns: renewing it then costs less than
  // one more correction. The dense work on it must also be less than the elimination of all.
  constexpr double smallest_share = 4, most_work = 500;
  const double part = static_cast<double>(unknowns.size()), whole = static_cast<double>(marked.size());
  if (smallest_share * part > whole || part * part * part > most_work * whole) {
    moving_ = {};
    return;
  }
  const DensePlaces index_of{unknowns};
  locate_elements(moving_.elements, index_of, moving_.element_runs, moving_.twist_runs);
  for (ConstraintBlock& block : moving_.constraint_blocks) locate(block, index_of);
}

template void Assembly<2>::list_blocks();
template void Assembly<3>::list_blocks();
template bool Assembly<2>::couples_as(const Assembly&) const;
template bool Assembly<3>::couples_as(const Assembly&) const;
template void Assembly<2>::take_pattern(const Assembly&);
template void Assembly<3>::take_pattern(const Assembly&);
template bool Assembly<2>::shift_pattern(const Assembly&);
template bool Assembly<3>::shift_pattern(const Assembly&);
template void Assembly<2>::build_pattern();
template void Assembly<3>::build_pattern();
template void Assembly<2>::choose_moving_part();
template void Assembly<3>::choose_moving_part();

}  // namespace nurbeam
