#include "fem/forces/body_load.h"

#include <Eigen/Geometry>

#include "fem/element/dual.h"
#include "fem/mesh/attitude.h"

namespace nurbeam {

namespace {

using attitude::Quaternion;

// The generalised force of a moment on the attitude p.
template <class T>
Quaternion<T> of_moment(const Eigen::Vector3d& m, bool follower, const Quaternion<T>& p) {
  const attitude::Vector<T> moment = m.cast<T>(),
                            own = follower ? moment : attitude::turned_back<T>(p, moment);
  return 2.0 * attitude::from_moment<T>(p, own);
}

// The turn between two attitudes, along the axes of the model [rad].
Eigen::Vector3d turn(const Eigen::Vector4d& from, const Eigen::Vector4d& to) {
  const Eigen::Quaterniond a(from[0], from[1], from[2], from[3]), b(to[0], to[1], to[2], to[3]);
  const Eigen::AngleAxisd by((b * a.conjugate()).normalized());
  return by.angle() * by.axis();
}

}  // namespace

template <int D>
BoundBodyLoad<D>::BoundBodyLoad(const BodyLoad& load, const MeshedBeams<D>& at, const Eigen::VectorXd&)
    : load_(&load),
      p_(load.turns >= 0 && (load.is_moment || load.follower) ? at.mesh.attitudes[load.turns] : -1) {
  for (int d = 0; d < D && !load.is_moment; ++d) dofs_.push_back(at.mesh.bodies[load.body] + d);
  for (int k = 0; k < 4 && p_ >= 0; ++k) dofs_.push_back(p_ + k);
}

template <int D>
double BoundBodyLoad<D>::factor(const State& state) const {
  return load_->time.empty() ? state.load : state.load * value_and_slope(load_->time, state.t).first;
}

template <int D>
Eigen::Vector3d BoundBodyLoad<D>::present(const State& state) const {
  const Eigen::Vector3d value = factor(state) * load_->value;
  return load_->follower && p_ >= 0 ? attitude::turned<double>(state.q.segment<4>(p_), value) : value;
}

template <int D>
void BoundBodyLoad<D>::add_force(const MeshedBeams<D>&, const State& state,
                                 Eigen::Ref<Eigen::VectorXd> dynamics) const {
  if (!load_->is_moment)
    dynamics.segment<D>(dofs_[0]) -= present(state).template head<D>();
  else if (p_ >= 0)
    dynamics.segment<4>(p_) -=
        of_moment<double>(factor(state) * load_->value, load_->follower, state.q.segment<4>(p_));
}

template <int D>
Eigen::MatrixXd BoundBodyLoad<D>::tangent(const State& state, double weight) const {
  const auto n = static_cast<Eigen::Index>(dofs_.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  if (p_ < 0) return K;
  const Eigen::Vector4d p = state.q.segment<4>(p_);
  const Eigen::Vector3d value = factor(state) * load_->value;
  if (!load_->is_moment) {
    K.topRightCorner(D, 4) = -weight * attitude::gradient(p, value).template topRows<D>();
    return K;
  }
  Quaternion<Dual<4>> x;
  for (int k = 0; k < 4; ++k) x[k] = Dual<4>::variable(p[k], k);
  const Quaternion<Dual<4>> force = of_moment<Dual<4>>(value, load_->follower, x);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) K(i, j) = -weight * force[i].d[j];
  return K;
}

template <int D>
double BoundBodyLoad<D>::work(const MeshedBeams<D>&, const State& from, const State& to) const {
  const Eigen::Vector3d mean = (present(from) + present(to)) / 2;
  if (!load_->is_moment)
    return mean.template head<D>().dot(to.q.segment<D>(dofs_[0]) - from.q.segment<D>(dofs_[0]));
  return p_ < 0 ? 0 : mean.dot(turn(from.q.segment<4>(p_), to.q.segment<4>(p_)));
}

template <int D>
Eigen::Matrix<double, D, 1> BoundBodyLoad<D>::on_body(const MeshedBeams<D>&, int body,
                                                      const State& state) const {
  if (load_->is_moment || body != load_->body) return Eigen::Matrix<double, D, 1>::Zero();
  return present(state).template head<D>();
}

template class BoundBodyLoad<2>;
template class BoundBodyLoad<3>;

}  // namespace nurbeam
