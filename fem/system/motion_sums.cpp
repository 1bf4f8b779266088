// Sums over all elements of a motion, and their transfer to another mesh.
#include <algorithm>

#include "fem/mesh/widened.h"
#include "fem/system/observables.h"
#include "fem/system/same_elements.h"
#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

void add_twist_energy(const MeshElement<3>& e, const State& state, SystemEnergy& sum) {
  const TwistEnergy part = e.twist->element.energy(gather_twist(e, state));
  sum.kinetic += part.kinetic;
  sum.bending += part.bending;
  sum.torsion += part.torsion;
  sum.dissipation += part.dissipation;
}

void add_axis_energy(const ElementEnergy& axis, SystemEnergy& sum) {
  sum.kinetic += axis.kinetic;
  sum.axial += axis.axial;
  sum.bending += axis.bending;
  sum.gravity += axis.external;
  sum.dissipation += axis.dissipation;
}

template <int D>
void add_force_energies(const Assembly<D>& a, const State& state, SystemEnergy& sum) {
  const MeshedBeams<D> at = a.beams();
  for (const BoundForce<D>& force : a.forces())
    std::visit(
        [&](const auto& f) {
          if constexpr (offers_of<decltype(f)>.energy) f.add_energy(at, state, sum);
        },
        force);
}

// Energy of the elements that count and of forces. `counts`: per element of the system; null: all.
template <int D>
SystemEnergy energy_of(const Assembly<D>& a, const State& state, const std::vector<bool>* counts = nullptr) {
  SystemEnergy sum;
  add_axis_energy(a.axis_energy(state, counts), sum);
  if constexpr (D == 3)
    for (std::size_t i = 0; i < a.elements().size(); ++i)
      if (a.elements()[i].twist && (!counts || (*counts)[i])) add_twist_energy(a.elements()[i], state, sum);
  add_force_energies(a, state, sum);
  return sum;
}

// Momentum of an element: the shape functions of positions add up to one, so their rows of the momentum add
// up to the whole.
template <int D>
Eigen::Matrix<double, D, 1> momentum_of(const MeshElement<D>& e, const State& state) {
  using Layout = ElementLayout<D>;
  using Vector = Eigen::Matrix<double, D, 1>;
  if (e.element.fixed()) {
    const ElementNodes<D> nodal = e.element.nodal_momentum(node_rates(e, state.v));
    return nodal.col(0) + nodal.col(2);
  }
  const ElementState<D> x = gather<D>(e, state);
  const ElementVector<D> p = e.element.tangent(x, Vector::Zero(), {.mass = 1}) * x.v;
  return p.template segment<D>(Layout::r(0)) + p.template segment<D>(Layout::r(1));
}

template <int D>
void add_force_momenta(const Assembly<D>& a, const State& state, Eigen::Matrix<double, D, 1>& sum) {
  for (const BoundForce<D>& force : a.forces())
    std::visit(
        [&](const auto& f) {
          if constexpr (offers_of<decltype(f)>.momentum) sum += f.momentum(state);
        },
        force);
}

template <int D>
Eigen::Vector3d momentum_of(const Assembly<D>& a, const State& state) {
  Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero();
  for (const MeshElement<D>& e : a.elements()) sum += momentum_of(e, state);
  add_force_momenta(a, state, sum);
  return widened<D>(sum);
}

// Sums over the forces and the elements that count.
template <int D>
MotionSums sums_of(const Assembly<D>& a, const State& state, int beam, const std::vector<bool>& counts) {
  MotionSums sums{.energy = energy_of(a, state, &counts)};
  Eigen::Matrix<double, D, 1> momentum = Eigen::Matrix<double, D, 1>::Zero();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (!counts[i]) continue;
    const MeshElement<D>& e = a.elements()[i];
    momentum += momentum_of(e, state);
    if (e.span->beam == beam) sums.length += e.element.length(gather<D>(e, state.q));
  }
  add_force_momenta(a, state, momentum);
  sums.momentum = widened<D>(momentum);
  return sums;
}

void add(const SystemEnergy& other, double factor, SystemEnergy& energy) {
  energy.kinetic += factor * other.kinetic;
  energy.gravity += factor * other.gravity;
  energy.axial += factor * other.axial;
  energy.bending += factor * other.bending;
  energy.torsion += factor * other.torsion;
  energy.spring += factor * other.spring;
  energy.dissipation += factor * other.dissipation;
}

void add(const MotionSums& other, double factor, MotionSums& sums) {
  add(other.energy, factor, sums.energy);
  sums.momentum += factor * other.momentum;
  sums.length += factor * other.length;
}

// Whether an element moves exactly as the same element in another mesh.
template <int D>
bool moves_alike(const MeshElement<D>& e, const State& state, const MeshElement<D>& other,
                 const State& other_state) {
  const MeshSpan &span = *e.span, &of_other = *other.span;
  if (e.twist || span.start(state.q) != of_other.start(other_state.q) ||
      span.end(state.q) != of_other.end(other_state.q))
    return false;
  constexpr int nodal = ElementLayout<D>::nodal;
  if (const int first = first_coordinate(e), of_first = first_coordinate(other);
      e.element.fixed() && first >= 0 && of_first >= 0)
    return state.q.segment<nodal>(first) == other_state.q.segment<nodal>(of_first) &&
           state.v.segment<nodal>(first) == other_state.v.segment<nodal>(of_first);
  for (int k = 0; k < element_size<D>; ++k) {
    const int i = e.dofs[k], j = other.dofs[k];
    if (i >= 0 && (state.q[i] != other_state.q[j] || state.v[i] != other_state.v[j])) return false;
  }
  return true;
}

// The elements of a system that move differently in two states.
template <int D>
std::vector<bool> unlike_motion(const Assembly<D>& a, const State& state, const State& other) {
  const Eigen::Array<bool, Eigen::Dynamic, 1> differs =
      state.q.array() != other.q.array() || state.v.array() != other.v.array();
  const auto any = [&](const auto& dofs) {
    return std::any_of(dofs.begin(), dofs.end(), [&](int i) { return i >= 0 && differs[i]; });
  };
  std::vector<bool> unlike;
  unlike.reserve(a.elements().size());
  for (const MeshElement<D>& e : a.elements()) {
    bool is_unlike = any(e.dofs);
    if constexpr (D == 3) is_unlike = is_unlike || (e.twist && any(e.twist->dofs));
    unlike.push_back(is_unlike);
  }
  return unlike;
}

// The elements of two systems that the other does not have, or that move differently there.
template <int D>
std::array<std::vector<bool>, 2> unlike_motion(const Assembly<D>& a, const State& state,
                                               const Assembly<D>& other, const State& other_state) {
  const std::vector<const MeshElement<D>*> same = same_elements(a, other);
  std::array<std::vector<bool>, 2> unlike{std::vector<bool>(same.size(), true),
                                          std::vector<bool>(other.elements().size(), true)};
  for (std::size_t i = 0; i < same.size(); ++i)
    if (same[i] && moves_alike(a.elements()[i], state, *same[i], other_state))
      unlike[0][i] = unlike[1][static_cast<std::size_t>(same[i] - other.elements().data())] = false;
  return unlike;
}

}  // namespace

SystemEnergy energy(const BeamSystem& system, const State& state) {
  return with_assembly(
      system, [&](const auto& a) { return energy_of(a, state); });
}

SystemEnergy carried_energy(const SystemEnergy& known, const BeamSystem& system, const State& first,
                            const State& other) {
  return with_assembly(
      system,
      [&]<int D>(const Assembly<D>& a) {
        const std::vector<bool> moves = unlike_motion(a, first, other);
        SystemEnergy carried = known;
        add(energy_of(a, other, &moves), 1, carried);
        add(energy_of(a, first, &moves), -1, carried);
        return carried;
      });
}

Eigen::Vector3d momentum(const BeamSystem& system, const State& state) {
  return with_assembly(
      system, [&](const auto& a) { return momentum_of(a, state); });
}

MotionSums motion_sums(const BeamSystem& system, const State& state, int beam) {
  return {energy(system, state), momentum(system, state), beam_length(system, state, beam)};
}

MotionSums carried_sums(const MotionSums& sums, const BeamSystem& from, const State& state,
                        const BeamSystem& to, const State& next, int beam) {
  return with_assembly(
      to,
      [&]<int D>(const Assembly<D>& fresh) {
        const Assembly<D>& old = *from.assembly<D>();
        const auto [added, removed] = unlike_motion(fresh, next, old, state);
        MotionSums carried = sums;
        add(sums_of(fresh, next, beam, added), 1, carried);
        add(sums_of(old, state, beam, removed), -1, carried);
        return carried;
      });
}

double energy_change(const BeamSystem& from, const State& state, const BeamSystem& to, const State& next) {
  return with_assembly(
      to,
      [&]<int D>(const Assembly<D>& fresh) {
        const Assembly<D>& old = *from.assembly<D>();
        const auto [added, removed] = unlike_motion(fresh, next, old, state);
        return energy_of(fresh, next, &added).mechanical() - energy_of(old, state, &removed).mechanical();
      });
}

double beam_length(const BeamSystem& system, const State& state, int beam) {
  return with_assembly(
      system, [&](const auto& a) { return a.length(beam, state); });
}

}  // namespace nurbeam
