// The tangents of an assembly and where their entries are.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "fem/comparison/virtual_work.h"
#include "fem/system/assembly.h"
#include "fem/system/coupling.h"

namespace nurbeam {

namespace {

// Where the entries of a sparse matrix are among its values.
struct SparsePlaces {
  const SparsePattern& of;

  int start(int column) const { return of.column_starts()[column]; }
  /// `guess`: how far it may be from the start of its column.
  int operator()(int row, int column, int guess) const {
    const int* const all = of.rows().data();
    const int begin = start(column), end = start(column + 1);
    if (guess < end - begin && all[begin + guess] == row) return begin + guess;
    return static_cast<int>(std::lower_bound(all + begin, all + end, row) - all);
  }
};

// The same of the dense matrix of some unknowns, in order.
struct DensePlaces {
  const std::vector<int>& unknowns;

  int place(int unknown) const {
    return static_cast<int>(std::lower_bound(unknowns.begin(), unknowns.end(), unknown) - unknowns.begin());
  }
  int start(int column) const { return place(column) * static_cast<int>(unknowns.size()); }
  int operator()(int row, int column, int) const { return start(column) + place(row); }
};

// The coordinates of a bound force in its own block, where it has one.
template <class Force>
std::vector<int> own_dofs(const Force& force) {
  if constexpr (requires { force.dofs(); })
    return force.dofs();
  else
    return {};
}

}  // namespace

// Adds a matrix in the coordinates of a contribution.
template <int D>
template <class Matrix>
void Assembly<D>::scatter(Runs runs, const Matrix& matrix, double* values) {
  for (const Run& run : runs)
    for (int i = 0; i < run.count; ++i) values[run.value + i] += matrix(run.row + i, run.column);
}

// Of which contributions the tangents are asked for: all, or those to the rows of unknowns that are near.
template <int D>
struct Assembly<D>::All {
  bool operator()(int) const { return true; }
  bool operator()(const Block&) const { return true; }
  bool operator()(const ConstraintBlock&) const { return true; }
};
template <int D>
struct Assembly<D>::Near {
  const Assembly& of;
  const std::vector<bool>& near;

  bool any(std::span<const int> dofs) const {
    return std::any_of(
        dofs.begin(), dofs.end(), [&](int dof) { return dof >= 0 && near[dof]; });
  }
  bool operator()(const Block& block) const { return any(block.dofs); }
  bool operator()(int element) const {
    return any(of.elements_[element].dofs) || any(of.twist_dofs(element));
  }
  bool operator()(const ConstraintBlock& constraint) const {
    const auto first = near.begin() + of.mesh_.coordinate_count + constraint.row;
    return (*this)(constraint.block) ||
           std::find(first, first + constraint.rows, true) != first + constraint.rows;
  }
};

// Takes the tangent matrices of one force.
template <int D>
template <class Wanted>
struct Assembly<D>::Sink {
  const ElementRuns &element_runs, &twist_runs;
  const Block& own_block;
  const Wanted& wanted;
  double* values;

  void element(int index, const ElementMatrix<D>& K) const {
    if (wanted(index)) scatter(element_runs[index], K, values);
  }
  /// In the coordinates of an element with its sections.
  void twist(int index, const TwistLayout::Matrix& K) const {
    if (wanted(index)) scatter(twist_runs[index], K, values);
  }
  template <class Matrix>
  void own(const Matrix& K) const {
    if (wanted(own_block)) scatter(own_block.runs, K, values);
  }
};

// None without torsion.
template <int D>
std::span<const int> Assembly<D>::twist_dofs(int element) const {
  if (!elements_[element].twist) return {};
  return elements_[element].twist->dofs;
}

template <int D>
void Assembly<D>::list_blocks() {
  for (const BoundForce<D>& force : forces_)
    force_blocks_.push_back({std::visit([](const auto& f) { return own_dofs(f); }, force), {}});
}

// Whether both couple the same coordinates and move the same of them.
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
  const int n = mesh_.coordinate_count;
  Coupling coupling(n + constraint_count_);
  const auto couple = [&](std::span<const int> dofs) {
    coupling.add(dofs);
    coupling.close();
  };
  for (const MeshElement<D>& e : elements_)
    couple(e.twist ? std::span<const int>(e.twist->dofs) : std::span<const int>(e.dofs));
  for (const Block& force : force_blocks_) couple(force.dofs);
  for (const ConstraintBlock& constraint : constraint_blocks_) {
    coupling.add(constraint.block.dofs);
    coupling.add(n + constraint.row, constraint.rows);
    coupling.close();
  }
  pattern_ = coupling.pattern();

  const SparsePlaces index_of{pattern_};
  std::vector<int> all(elements_.size());
  std::iota(all.begin(), all.end(), 0);
  locate_elements(all, index_of, element_runs_, twist_runs_);
  for (Block& block : force_blocks_) locate(block.dofs, index_of, block.runs);
  for (ConstraintBlock& block : constraint_blocks_) locate(block, index_of);
}

// Adds where the entries of a contribution are; `index_of` gives that of a row and a column. Rows that follow
// one another do so among all entries, which hold each of them. In the columns of one node they are as far
// from the start.
template <int D>
template <class IndexOf>
void Assembly<D>::locate(std::span<const int> dofs, const IndexOf& index_of, std::vector<Run>& runs) {
  struct Rows {
    int first;
    std::uint8_t at, count;
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
      in_column[count++] = {dofs[i], static_cast<std::uint8_t>(i), 1};
  }
  int previous = -1;  // start of the column before
  for (std::size_t j = 0; j < dofs.size(); ++j) {
    if (dofs[j] < 0) continue;
    for (std::size_t k = 0; k < count; ++k) {
      const int guess = previous < 0 ? 0 : runs[runs.size() - count].value - previous;
      runs.push_back({index_of(in_column[k].first, dofs[j], guess), static_cast<std::uint8_t>(j),
                      in_column[k].at, in_column[k].count});
    }
    previous = index_of.start(dofs[j]);
  }
}

// Of these elements, one after the other.
template <int D>
template <class IndexOf>
void Assembly<D>::locate_elements(const std::vector<int>& elements, const IndexOf& index_of,
                                  ElementRuns& element_runs, ElementRuns& twist_runs) const {
  element_runs.runs.reserve(elements.size() * ElementLayout<D>::nodal);
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

// Marks all unknowns of constraints that hold one that is marked, and of those that hold one of these: what
// is left is constrained by itself.
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
    if (std::visit([](const auto& c) { return is_linear<std::decay_t<decltype(c)>>(); }, constraints_[i]))
      continue;
    moving_.constraints.push_back(i);
    moving_.constraint_blocks.push_back(constraint_blocks_[i]);
    mark(constraint_blocks_[i].block.dofs);
  }
  mark_constrained(marked);
  std::vector<int>& unknowns = moving_.unknowns;
  for (int i = 0; i < static_cast<int>(marked.size()); ++i)
    if (marked[i]) unknowns.push_back(i);
  // A part is kept apart where it is a small share of all unknowns, so that another correction costs more
  // than to renew it, and where dense work on it takes less than the elimination of all.
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

template <int D>
void Assembly<D>::add_element_tangent(int i, const State& state, const Vector& load, const TangentWeights& w,
                                      Runs runs, Runs twist_runs, double* values) const {
  const MeshElement<D>& e = elements_[i];
  const ElementState<D> x = gather<D>(e, state);
  scatter(runs,
          is_form_p(e) ? virtual_work::tangent<D>(e.element, x, load, w) : e.element.tangent(x, load, w),
          values);
  if constexpr (D == 3)
    if (e.twist) scatter(twist_runs, e.twist->element.tangent(gather_twist(e, state), w), values);
}

// Of all batches of a beam that hold a wanted element.
template <int D>
template <class Wanted>
void Assembly<D>::add_batch_tangents(int beam, const State& state, const TangentWeights& w,
                                     const Wanted& wanted, double* values) const {
  const auto& batches = walks_[beam].batches;
  const auto& batched = walks_[beam].batched;
  if (batches.empty()) return;                  // a guide has no elements
  if (w.mass == 0 && w.stiffness == 0) return;  // they are not damped
  const double strain = free_strain_of(beam, state);
  for_each_batch(walks_[beam], [&](int i) {
    const int* begin = batched.data() + i * ElementBatch<D>::lanes;
    const int count = batches[i].count();
    if (std::none_of(begin, begin + count, wanted)) return;
    typename ElementBatch<D>::Tangents K;
    batches[i].tangents(state, strain, w, K);
    for (int lane = 0; lane < count; ++lane) {
      if (!wanted(begin[lane])) continue;
      for (const Run& run : element_runs_[begin[lane]])
        for (int k = 0; k < run.count; ++k) values[run.value + k] += K[run.column][run.row + k].of(lane);
    }
  });
}

template <int D>
void Assembly<D>::add_constraint_tangent(int i, const State& state, const TangentWeights& w,
                                         const ConstraintBlock& block, double* values) const {
  const MeshedBeams<D> at = beams();
  std::visit(
      [&](const auto& c) {
        typename ConstraintTerms<D>::Multipliers y = ConstraintTerms<D>::Multipliers::Zero();
        y.head(c.rows) = state.lambda.segment(block.row, c.rows);
        const ConstraintTerms<D> terms = c.terms(at, state, &y);
        if constexpr (!is_linear<std::decay_t<decltype(c)>>())
          if (w.stiffness != 0) scatter(block.block.runs, w.stiffness * terms.hessian, values);
        for (std::size_t k = 0, v = 0; k < block.block.dofs.size(); ++k)
          for (int r = 0; r < c.rows; ++r, ++v)
            if (block.gradient_values[v] >= 0) {
              const double g = terms.gradient(r, static_cast<Eigen::Index>(k));
              values[block.gradient_values[v]] += g;
              values[block.transposed_values[v]] += g;
            }
      },
      constraints_[i]);
}

// Of what is wanted.
template <int D>
template <class Wanted>
void Assembly<D>::add_tangents(const State& state, const TangentWeights& w, const Wanted& wanted,
                               double* values, Moving moving) const {
  const MeshedBeams<D> at = beams();
  const bool constraints_only = w.mass == 0 && w.damping == 0 && w.stiffness == 0;
  for (int b = 0; b < static_cast<int>(model_->beams.size()) && !constraints_only; ++b) {
    const Vector load = line_load(b, state);
    const auto add_one = [&](int i) {
      if (moving == Moving::left_out && !elements_[i].element.fixed()) return;
      if (wanted(i)) add_element_tangent(i, state, load, w, element_runs_[i], twist_runs_[i], values);
    };
    if (model_->beams[b].properties.is_damped())
      std::for_each(walks_[b].batched.begin(), walks_[b].batched.end(), add_one);
    else
      add_batch_tangents(b, state, w, wanted, values);
    std::for_each(walks_[b].others.begin(), walks_[b].others.end(), add_one);
  }
  for (std::size_t i = 0; i < forces_.size() && !constraints_only; ++i) {
    const Sink<Wanted> sink{element_runs_, twist_runs_, force_blocks_[i], wanted, values};
    std::visit(
        [&](const auto& f) {
          if constexpr (requires { f.template add_tangent<D>(at, state, w, sink); })
            f.template add_tangent<D>(at, state, w, sink);
          else if constexpr (requires { f.add_tangent(at, state, w, sink); })
            f.add_tangent(at, state, w, sink);
        },
        forces_[i]);
  }
  for (int i = 0; i < static_cast<int>(constraints_.size()); ++i)
    if (wanted(constraint_blocks_[i])) add_constraint_tangent(i, state, w, constraint_blocks_[i], values);
}

template <int D>
void Assembly<D>::tangent(const State& state, const TangentWeights& w, SparseValues kkt) const {
  double* values = kkt.valuePtr();
  std::fill(values, values + kkt.nonZeros(), 0.0);
  add_tangents(state, w, All{}, values);
}

// Elements whose ends move are gone over once.
template <int D>
void Assembly<D>::tangents(const State& state, const std::array<TangentWeights, 2>& w,
                           const std::array<Eigen::SparseMatrix<double>*, 2>& kkt) const {
  for (const std::size_t k : {0, 1}) {
    std::fill(kkt[k]->valuePtr(), kkt[k]->valuePtr() + kkt[k]->nonZeros(), 0.0);
    add_tangents(state, w[k], All{}, kkt[k]->valuePtr(), Moving::left_out);
  }
  for (const int i : moving_spans_) {
    const MeshElement<D>& e = elements_[i];
    const Vector load = line_load(e.beam, state);
    const ElementState<D> x = gather<D>(e, state);
    std::array<ElementMatrix<D>, 2> both;
    if (is_form_p(e))
      both = {virtual_work::tangent<D>(e.element, x, load, w[0]),
              virtual_work::tangent<D>(e.element, x, load, w[1])};
    else
      both = e.element.tangents(x, load, w);
    for (const std::size_t k : {0, 1}) {
      scatter(element_runs_[i], both[k], kkt[k]->valuePtr());
      if constexpr (D == 3)
        if (e.twist)
          scatter(twist_runs_[i], e.twist->element.tangent(gather_twist(e, state), w[k]), kkt[k]->valuePtr());
    }
  }
}

template <int D>
void Assembly<D>::tangent_near(const State& state, const TangentWeights& w, const std::vector<bool>& near,
                               double* values) const {
  add_tangents(state, w, Near{*this, near}, values);
}

template <int D>
void Assembly<D>::moving_tangent(const State& state, const TangentWeights& w, Eigen::MatrixXd& part) const {
  const auto size = static_cast<Eigen::Index>(moving_.unknowns.size());
  part.setZero(size, size);
  for (int k = 0; k < static_cast<int>(moving_.elements.size()); ++k)
    add_element_tangent(moving_.elements[k], state, line_load(elements_[moving_.elements[k]].beam, state), w,
                        moving_.element_runs[k], moving_.twist_runs[k], part.data());
  for (std::size_t k = 0; k < moving_.constraints.size(); ++k)
    add_constraint_tangent(moving_.constraints[k], state, w, moving_.constraint_blocks[k], part.data());
}

template void Assembly<2>::list_blocks();
template void Assembly<3>::list_blocks();
template bool Assembly<2>::couples_as(const Assembly&) const;
template bool Assembly<3>::couples_as(const Assembly&) const;
template void Assembly<2>::take_pattern(const Assembly&);
template void Assembly<3>::take_pattern(const Assembly&);
template <int D>
bool Assembly<D>::has_constant_inertia() const {
  const auto is_constant = [](const auto& force) {
    return requires { force.has_constant_inertia; };
  };
  return std::all_of(elements_.begin(), elements_.end(),
                     [](const MeshElement<D>& e) {
                       return e.element.fixed() && !e.twist && !e.element.properties().is_damped();
                     }) &&
         std::all_of(forces_.begin(), forces_.end(),
                     [&](const BoundForce<D>& force) { return std::visit(is_constant, force); });
}

template bool Assembly<2>::has_constant_inertia() const;
template bool Assembly<3>::has_constant_inertia() const;
template void Assembly<2>::build_pattern();
template void Assembly<3>::build_pattern();
template void Assembly<2>::choose_moving_part();
template void Assembly<3>::choose_moving_part();
template void Assembly<2>::tangent(const State&, const TangentWeights&, SparseValues) const;
template void Assembly<3>::tangent(const State&, const TangentWeights&, SparseValues) const;
template void Assembly<2>::tangents(const State&, const std::array<TangentWeights, 2>&,
                                    const std::array<Eigen::SparseMatrix<double>*, 2>&) const;
template void Assembly<3>::tangents(const State&, const std::array<TangentWeights, 2>&,
                                    const std::array<Eigen::SparseMatrix<double>*, 2>&) const;
template void Assembly<2>::tangent_near(const State&, const TangentWeights&, const std::vector<bool>&,
                                        double*) const;
template void Assembly<3>::tangent_near(const State&, const TangentWeights&, const std::vector<bool>&,
                                        double*) const;
template void Assembly<2>::moving_tangent(const State&, const TangentWeights&, Eigen::MatrixXd&) const;
template void Assembly<3>::moving_tangent(const State&, const TangentWeights&, Eigen::MatrixXd&) const;

}  // namespace nurbeam
