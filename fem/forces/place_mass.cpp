#include "fem/forces/place_mass.h"

#include "fem/mesh/grip_position.h"

namespace nurbeam {

template <int D>
BoundPlaceMass<D>::BoundPlaceMass(const PlaceMass& mass, const MeshedBeams<D>& at, const Eigen::VectorXd&)
    : mass_(mass) {
  const int r = *grip_position(at.structure, at.mesh, Grip::on_beam(mass.beam, mass.s), "a mass");
  for (int d = 0; d < D; ++d) dofs_.push_back(r + d);
}

template <int D>
typename BoundPlaceMass<D>::Vector BoundPlaceMass<D>::weight(const MeshedBeams<D>& at) const {
  return (mass_.weighs ? mass_.mass : 0) * at.structure.gravity.template head<D>();
}

template <int D>
void BoundPlaceMass<D>::add_force(const MeshedBeams<D>& at, const State& state,
                                  Eigen::Ref<Eigen::VectorXd> dynamics) const {
  dynamics.segment<D>(dofs_[0]) +=
      mass_.mass * (state.a.segment<D>(dofs_[0]) - field_on_point<D>(at.structure, state, dofs_[0])) -
      state.load * weight(at);
}

template <int D>
void BoundPlaceMass<D>::add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
  sum.kinetic += mass_.mass * state.v.segment<D>(dofs_[0]).squaredNorm() / 2;
  sum.gravity += mass_.mass * field_potential<D>(at.structure, state, dofs_[0]) -
                 weight(at).dot(state.q.segment<D>(dofs_[0]));
}

template class BoundPlaceMass<2>;
template class BoundPlaceMass<3>;

}  // namespace nurbeam
