#include "fem/forces/body_drag.h"

namespace nurbeam {

template <int D>
BodyDrag<D>::BodyDrag(const MeshedBeams<D>& at, int body)
    : body_(body), factor_(at.structure.air.density * at.structure.bodies[body].drag_area / 2) {
  for (int d = 0; d < D; ++d) dofs_.push_back(at.mesh.bodies[body] + d);
}

template <int D>
typename BodyDrag<D>::Vector BodyDrag<D>::relative_velocity(const MeshedBeams<D>& at,
                                                            const State& state) const {
  return at.structure.air.wind.template head<D>() - state.v.segment<D>(dofs_[0]);
}

template <int D>
typename BodyDrag<D>::Vector BodyDrag<D>::force(const MeshedBeams<D>& at, const State& state) const {
  const Vector w = relative_velocity(at, state);
  return state.load * factor_ * w.norm() * w;
}

template <int D>
void BodyDrag<D>::add_force(const MeshedBeams<D>& at, const State& state,
                            Eigen::Ref<Eigen::VectorXd> dynamics) const {
  dynamics.segment<D>(dofs_[0]) -= force(at, state);
}

template <int D>
Eigen::Matrix<double, D, D> BodyDrag<D>::tangent(const MeshedBeams<D>& at, const State& state,
                                                 const TangentWeights& w) const {
  const Vector u = relative_velocity(at, state);
  const double speed = u.norm();
  Eigen::Matrix<double, D, D> by_velocity = Eigen::Matrix<double, D, D>::Zero();
  if (speed > 0) by_velocity = u * u.transpose() / speed;
  by_velocity.diagonal().array() += speed;
  return w.damping * state.load * factor_ * by_velocity;
}

template <int D>
typename BodyDrag<D>::Vector BodyDrag<D>::mean_force(const MeshedBeams<D>& at, const State& from,
                                                     const State& to) const {
  return (force(at, from) + force(at, to)) / 2;
}

template <int D>
double BodyDrag<D>::loss(const MeshedBeams<D>& at, const State& from, const State& to) const {
  const Vector moved = to.q.segment<D>(dofs_[0]) - from.q.segment<D>(dofs_[0]);
  const Vector blown = (to.t - from.t) * at.structure.air.wind.template head<D>();
  return mean_force(at, from, to).dot(blown - moved);
}

template <int D>
double BodyDrag<D>::work(const MeshedBeams<D>& at, const State& from, const State& to) const {
  return (to.t - from.t) * mean_force(at, from, to).dot(at.structure.air.wind.template head<D>());
}

template class BodyDrag<2>;
template class BodyDrag<3>;

}  // namespace nurbeam
