#include "fem/forces/point_mass.h"

namespace nurbeam {

template <int D>
void PointMass<D>::add_force(const MeshedBeams<D>& at, const State& state,
                             Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const Vector gravity = state.load * at.structure.gravity.template head<D>();
  dynamics.segment<D>(dofs_[0]) += mass_ * (state.a.segment<D>(dofs_[0]) - gravity);
}

template <int D>
Eigen::Matrix<double, D, D> PointMass<D>::tangent(const TangentWeights& w) const {
  return Vector::Constant(w.mass * mass_).asDiagonal();
}

template <int D>
void PointMass<D>::add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
  sum.kinetic += mass_ * state.v.segment<D>(dofs_[0]).squaredNorm() / 2;
  sum.gravity -= mass_ * at.structure.gravity.template head<D>().dot(state.q.segment<D>(dofs_[0]));
}

template <int D>
typename PointMass<D>::Vector PointMass<D>::momentum(const State& state) const {
  return mass_ * state.v.segment<D>(dofs_[0]);
}

template class PointMass<2>;
template class PointMass<3>;

}  // namespace nurbeam
