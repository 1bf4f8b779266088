// The forces of many fixed elements at once, for the widest registers that the processor has.
#include "fem/element/element_batch.h"

#include <algorithm>

#include "fem/element/batch_kernel.h"

namespace nurbeam {

template <>
NURBEAM_FOR_EVERY_PROCESSOR void ElementBatch<2>::add_forces(const State& state, const Vector& load,
                                                             double free_strain, double* forces,
                                                             std::ptrdiff_t stride) const {
  Kernel(*this, free_strain, state).add_forces(state, load, forces, stride);
}

template <>
NURBEAM_FOR_EVERY_PROCESSOR void ElementBatch<3>::add_forces(const State& state, const Vector& load,
                                                             double free_strain, double* forces,
                                                             std::ptrdiff_t stride) const {
  Kernel(*this, free_strain, state).add_forces(state, load, forces, stride);
}

template <>
NURBEAM_FOR_EVERY_PROCESSOR std::array<ElementEnergy, ElementBatch<2>::lanes> ElementBatch<2>::energies(
    const State& state, const Vector& load, double free_strain) const {
  return Kernel(*this, free_strain, state).energies(state, load);
}

template <>
NURBEAM_FOR_EVERY_PROCESSOR std::array<ElementEnergy, ElementBatch<3>::lanes> ElementBatch<3>::energies(
    const State& state, const Vector& load, double free_strain) const {
  return Kernel(*this, free_strain, state).energies(state, load);
}

template <>
NURBEAM_FOR_EVERY_PROCESSOR std::array<double, ElementBatch<2>::lanes> ElementBatch<2>::lengths(
    const State& state) const {
  return Kernel(*this, 0, state).lengths(state);
}

template <>
NURBEAM_FOR_EVERY_PROCESSOR std::array<double, ElementBatch<3>::lanes> ElementBatch<3>::lengths(
    const State& state) const {
  return Kernel(*this, 0, state).lengths(state);
}

template <>
NURBEAM_FOR_EVERY_PROCESSOR void ElementBatch<2>::tangents(const State& state, double free_strain,
                                                           const TangentWeights& w, Tangents& K) const {
  Kernel(*this, free_strain, state).tangents(state, w, K);
}

template <>
NURBEAM_FOR_EVERY_PROCESSOR void ElementBatch<3>::tangents(const State& state, double free_strain,
                                                           const TangentWeights& w, Tangents& K) const {
  Kernel(*this, free_strain, state).tangents(state, w, K);
}

template <int D>
ElementBatch<D>::ElementBatch(const BeamProperties& properties) : properties_(&properties) {}

// Takes the numbers of an element. Numbers that stand side by side already are not copied; numbers that
// others share are not changed.
template <int D>
void ElementBatch<D>::take_numbers(const BeamElement<D>& element) {
  if (element.beside_ && element.lane_ == count_ && (count_ == 0 || element.beside_ == numbers_)) {
    numbers_ = element.beside_;
    return;
  }
  if (numbers_.use_count() != 1)
    numbers_ = numbers_ ? std::make_shared<FixedLanes>(*numbers_) : std::make_shared<FixedLanes>();
  BeamElement<D>(element).stand_beside(numbers_, count_);
}

template <int D>
FixedLanes ElementBatch<D>::numbers(const BeamElement<D>& element) {
  auto alone = std::make_shared<FixedLanes>();
  BeamElement<D>(element).stand_beside(alone, 0);
  return *alone;
}

template <int D>
void ElementBatch<D>::add(const BeamElement<D>& element, const std::array<int, element_size<D>>& dofs,
                          const Vector& slope_offset, int side, std::ptrdiff_t forces_at) {
  take_numbers(element);
  forces_at_[count_] = forces_at;
  // The first element fills the lanes beyond it until others take them.
  const int end = count_ == 0 ? lanes : count_ + 1;
  for (int i = count_; i < end; ++i) {
    for (int k = 0; k < nodal; ++k) dofs_[k][i] = dofs[k];
    for (int d = 0; d < D; ++d) slope_offset_[d].set(i, slope_offset[d]);
    sides_[i] = side;
  }
  for (int k = 0; k < nodal; ++k) same_dofs_ = same_dofs_ && dofs_[k][count_] == dofs_[k][0];
  ++count_;
  own_slopes_ = std::max(own_slopes_, element.own_slopes().count());
  forces_stand_beside_ = is_full() && same_dofs_;
  for (int i = 0; i < count_; ++i)
    forces_stand_beside_ = forces_stand_beside_ && forces_at_[i] == forces_at_[0] + i;
}

template class ElementBatch<2>;
template class ElementBatch<3>;

}  // namespace nurbeam
