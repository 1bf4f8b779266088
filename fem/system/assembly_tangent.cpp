// The tangents of an assembly, and its residuals and tangents near some unknowns.
#include <algorithm>
#include <array>
#include <utility>

#include "fem/comparison/virtual_work.h"
#include "fem/system/assembly.h"

namespace nurbeam {

// Adds a matrix in the coordinates of a contribution.
template <int D>
template <class Matrix>
void Assembly<D>::scatter(Runs runs, const Matrix& matrix, double* values) {
  for (const Run& run : runs)
    for (int j = 0; j < run.columns; ++j) {
      double* const column = values + run.value + j * run.stride;
      for (int i = 0; i < run.rows; ++i) column[i] += matrix(run.row + i, run.column + j);
    }
}

// The contributions whose tangents are wanted: all, or those in the rows of unknowns that are near.
template <int D>
struct Assembly<D>::All {
  bool operator()(int) const { return true; }
  bool operator()(const std::array<int, 2>&) const { return true; }
  bool operator()(const Block&) const { return true; }
  bool operator()(const ConstraintBlock&) const { return true; }
};
template <int D>
struct Assembly<D>::Near {
  const Assembly& of;
  const std::vector<bool>& near;
  std::vector<int> before;  // number of near coordinates before each

  Near(const Assembly& assembly, const std::vector<bool>& unknowns)
      : of(assembly), near(unknowns), before(static_cast<std::size_t>(of.mesh_.coordinate_count) + 1, 0) {
    for (int dof = 0; dof < of.mesh_.coordinate_count; ++dof) before[dof + 1] = before[dof] + near[dof];
  }

  bool any(std::span<const int> dofs) const {
    return std::any_of(
        dofs.begin(), dofs.end(), [&](int dof) { return dof >= 0 && near[dof]; });
  }
  /// Whether a coordinate between two may be near.
  bool operator()(const std::array<int, 2>& reach) const { return before[reach[1] + 1] > before[reach[0]]; }
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

// A sink for the tangent matrices of one force.
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
  /// Adds a matrix in the coordinates of an element with its sections.
  void twist(int index, const TwistLayout::Matrix& K) const {
    if (wanted(index)) scatter(twist_runs[index], K, values);
  }
  template <class Matrix>
  void own(const Matrix& K) const {
    if (wanted(own_block)) scatter(own_block.runs, K, values);
  }
};

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

// Adds the tangents of all batches of a beam that hold a wanted element.
template <int D>
template <class Wanted>
void Assembly<D>::add_batch_tangents(int beam, const State& state, const TangentWeights& w,
                                     const Wanted& wanted, double* values) const {
  const auto& batches = walks_[beam].batches;
  const auto& batched = walks_[beam].batched;
  if (batches.empty()) return;  // a guide has no elements
  const bool damped = w.damping != 0 && model_->beams[beam].properties.is_damped();
  if (w.mass == 0 && w.stiffness == 0 && !damped) return;
  const double strain = free_strain_of(beam, state);
  for_each_batch(walks_[beam], [&](int i) {
    const int* begin = batched.data() + i * ElementBatch<D>::lanes;
    const int count = batches[i].count();
    const auto is_wanted = [&](int element) { return wanted(element); };
    if (!wanted(walks_[beam].reaches[i]) || std::none_of(begin, begin + count, is_wanted)) return;
    typename ElementBatch<D>::Tangents K;
    batches[i].tangents(state, strain, w, K);
    for (int lane = 0; lane < count; ++lane) {
      if (!wanted(begin[lane])) continue;
      scatter(
          element_runs_[begin[lane]], [&](int row, int column) { return K[column][row].of(lane); }, values);
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
        if constexpr (!offers_of<decltype(c)>.linear)
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

// Adds the tangents of all wanted contributions.
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
    add_batch_tangents(b, state, w, wanted, values);
    std::for_each(walks_[b].others.begin(), walks_[b].others.end(), add_one);
  }
  for (std::size_t i = 0; i < forces_.size() && !constraints_only; ++i) {
    const Sink<Wanted> sink{element_runs_, twist_runs_, force_blocks_[i], wanted, values};
    std::visit(
        [&](const auto& f) {
          if constexpr (requires { f.template add_tangent<D>(at, state, w, sink); })
            f.template add_tangent<D>(at, state, w, sink);
          else if constexpr (offers_of<decltype(f)>.force)
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

// Elements with moving ends are visited once for both matrices.
template <int D>
void Assembly<D>::tangents(const State& state, const std::array<TangentWeights, 2>& w,
                           const std::array<Eigen::SparseMatrix<double>*, 2>& kkt) const {
  for (const std::size_t k : {0, 1}) {
    std::fill(kkt[k]->valuePtr(), kkt[k]->valuePtr() + kkt[k]->nonZeros(), 0.0);
    add_tangents(state, w[k], All{}, kkt[k]->valuePtr(), Moving::left_out);
  }
  for (const int i : moving_spans_) {
    const MeshElement<D>& e = elements_[i];
    const Vector load = line_load(e.span->beam, state);
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
  add_tangents(state, w, Near(*this, near), values);
}

template <int D>
void Assembly<D>::residual_near(const State& state, const std::vector<bool>& near,
                                Eigen::Ref<Eigen::VectorXd> dynamics,
                                Eigen::Ref<Eigen::VectorXd> constraints) const {
  const Near wanted(*this, near);
  dynamics.setZero();
  for (int b = 0; b < static_cast<int>(model_->beams.size()); ++b) {
    const Vector load = line_load(b, state);
    const auto& [batches, batched, others, reaches] = walks_[b];
    for (int i = 0; i < static_cast<int>(batches.size()); ++i)
      if (wanted(reaches[i])) add_part(b, i, state, load, dynamics);
    for (const int i : others)
      if (wanted(i)) add_element(elements_[i], state, load, dynamics);
  }
  add_forces_and_constraints(state, dynamics, constraints);
}

template <int D>
void Assembly<D>::moving_tangent(const State& state, const TangentWeights& w, Eigen::MatrixXd& part) const {
  const auto size = static_cast<Eigen::Index>(moving_.unknowns.size());
  part.setZero(size, size);
  for (int k = 0; k < static_cast<int>(moving_.elements.size()); ++k) {
    const int i = moving_.elements[k];
    add_element_tangent(i, state, line_load(elements_[i].span->beam, state), w, moving_.element_runs[k],
                        moving_.twist_runs[k], part.data());
  }
  for (std::size_t k = 0; k < moving_.constraints.size(); ++k)
    add_constraint_tangent(moving_.constraints[k], state, w, moving_.constraint_blocks[k], part.data());
}

template <int D>
bool Assembly<D>::has_constant_inertia() const {
  const auto is_constant = [](const auto& force) { return offers_of<decltype(force)>.has_constant_inertia; };
  return std::all_of(elements_.begin(), elements_.end(),
                     [](const MeshElement<D>& e) {
                       return e.element.fixed() && !e.twist && !e.element.properties().is_damped();
                     }) &&
         std::all_of(forces_.begin(), forces_.end(),
                     [&](const BoundForce<D>& force) { return std::visit(is_constant, force); });
}

template bool Assembly<2>::has_constant_inertia() const;
template bool Assembly<3>::has_constant_inertia() const;
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
template void Assembly<2>::residual_near(const State&, const std::vector<bool>&, Eigen::Ref<Eigen::VectorXd>,
                                         Eigen::Ref<Eigen::VectorXd>) const;
template void Assembly<3>::residual_near(const State&, const std::vector<bool>&, Eigen::Ref<Eigen::VectorXd>,
                                         Eigen::Ref<Eigen::VectorXd>) const;
template void Assembly<2>::moving_tangent(const State&, const TangentWeights&, Eigen::MatrixXd&) const;
template void Assembly<3>::moving_tangent(const State&, const TangentWeights&, Eigen::MatrixXd&) const;

}  // namespace nurbeam
