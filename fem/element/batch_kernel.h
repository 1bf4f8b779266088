#pragma once
#include "fem/element/element_batch.h"
#include "fem/element/fixed_kernel.h"
#include "fem/element/lane_arithmetic.h"

namespace nurbeam {

/// The formulas of fixed_kernel.h for a batch, to be compiled for each processor: coordinates are gathered,
/// forces scattered.
template <int D>
struct ElementBatch<D>::Kernel {
  using Formulas = FixedKernel<D, Lanes8, Lanes8>;

  const ElementBatch& batch;
  Lanes8 side;
  Formulas formulas;

  NURBEAM_WITHIN Kernel(const ElementBatch& of, double free_strain, const State& state)
      : batch(of),
        side(state.sides.size() > 0 ? gathered(state.sides.data(), of.sides_) : Lanes8{}),
        formulas{.beam = *of.properties_,
                 .sums = of.numbers_->sum,
                 .points = of.numbers_->at.data(),
                 .count = FixedLanes::points,
                 .free_strain = free_strain,
                 .side = state.sides.size() > 0 ? &side : nullptr,
                 .own_slopes = of.own_slopes_,
                 .stabilisation = state.stabilisation} {}
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  NURBEAM_WITHIN static Lanes8 gathered(const double* values, const std::array<int, lanes>& at) {
    return Lanes8{{{values[at[0]], values[at[1]], values[at[2]], values[at[3]]},
                   {values[at[4]], values[at[5]], values[at[6]], values[at[7]]}}};
  }
  NURBEAM_WITHIN Nodes gathered(const double* values) const {
    Nodes nodes;
    for (int k = 0; k < nodal; ++k) {
      const std::array<int, lanes>& at = batch.dofs_[k];
      if (batch.same_dofs_) {
        nodes[k / D][k % D] = Lanes8{} + values[at[0]];
        continue;
      }
      nodes[k / D][k % D] = gathered(values, at);
    }
    return nodes;
  }
  /// Nodal values of q.
  NURBEAM_WITHIN Nodes positions(const State& state) const {
    Nodes e = gathered(state.q.data());
    for (int d = 0; d < D; ++d) e[3][d] += batch.slope_offset_[d];
    return e;
  }
  /// Nodal values of v; unset without damping, where nothing reads them.
  NURBEAM_WITHIN Nodes rates(const State& state) const {
    Nodes e_rate;
    if (formulas.beam.is_damped()) e_rate = gathered(state.v.data());
    return e_rate;
  }
  NURBEAM_WITHIN static typename Formulas::Load components_of(const Vector& load) {
    typename Formulas::Load components;
    for (int d = 0; d < D; ++d) components[d] = load[d];
    return components;
  }

  NURBEAM_WITHIN void add_forces(const State& state, const Vector& load, double* forces,
                                 std::ptrdiff_t stride) const {
    scatter(formulas.force(positions(state), rates(state), gathered(state.a.data()), components_of(load)),
            forces, stride);
  }

  NURBEAM_WITHIN void scatter(const Nodes& force, double* forces, std::ptrdiff_t stride) const {
    using Half = double __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));
    if (batch.forces_stand_beside_) {
      for (int k = 0; k < nodal; ++k) {
        auto* sum = reinterpret_cast<Half*>(forces + batch.forces_at_[0] + batch.dofs_[k][0] * stride);
        for (int i = 0; i < 2; ++i) sum[i] += force[k / D][k % D].half[i];
      }
      return;
    }
    for (int i = 0; i < batch.count_; ++i)
      for (int k = 0; k < nodal; ++k)
        forces[batch.forces_at_[i] + batch.dofs_[k][i] * stride] += force[k / D][k % D].of(i);
  }

  NURBEAM_WITHIN std::array<ElementEnergy, lanes> energies(const State& state, const Vector& load) const {
    const auto sum = formulas.energies(positions(state), gathered(state.v.data()), components_of(load));
    std::array<ElementEnergy, lanes> each;
    for (int i = 0; i < batch.count_; ++i)
      each[i] = {sum.kinetic.of(i), sum.axial.of(i), sum.bending.of(i), sum.external.of(i),
                 sum.dissipation.of(i)};
    return each;
  }

  NURBEAM_WITHIN std::array<double, lanes> lengths(const State& state) const {
    const Lanes8 sum = formulas.length(positions(state));
    std::array<double, lanes> each;
    for (int i = 0; i < lanes; ++i) each[i] = sum.of(i);
    return each;
  }

  NURBEAM_WITHIN void tangents(const State& state, const TangentWeights& w, Tangents& K) const {
    formulas.tangents(positions(state), rates(state), w, K);
  }
};

}  // namespace nurbeam
