#include "fem/forces/rigid_inertia.h"

#include "fem/element/dual.h"
#include "fem/mesh/attitude.h"

namespace nurbeam {

template <class T>
Eigen::Matrix<T, 4, 1> RigidInertia::force(const Eigen::Matrix<T, 4, 1>& p, const Eigen::Matrix<T, 4, 1>& v,
                                           const Eigen::Matrix<T, 4, 1>& a, double load) const {
  using Vector = attitude::Vector<T>;
  const Eigen::Matrix<T, 3, 3> J = inertia_.cast<T>();
  const Vector spin = 2.0 * attitude::half_spin<T>(p, v);
  const Vector of_frame = attitude::turned_back<T>(p, Vector((load * rate_).cast<T>())),
               radial = attitude::turned_back<T>(p, Vector(radial_.cast<T>()));
  const Vector whole = spin + of_frame, rate = 2.0 * attitude::half_spin<T>(p, a) - spin.cross(of_frame),
               momentum = J * whole + rotor_.cast<T>(),
               gradient = (3 * load * rate_.squaredNorm()) * radial.cross(Vector(J * radial));
  const Vector moment = J * rate + whole.cross(momentum) - gradient;
  const T along = (4.0 / 3 * inertia_.trace()) * (p.dot(a) + v.dot(v));
  return 2.0 * attitude::from_moment<T>(p, moment) + along * p;
}

RigidInertia::RigidInertia(const MeshedBeams<3>& at, int body)
    : body_(body),
      inertia_(at.structure.bodies[body].rigid->inertia),
      rotor_(at.structure.bodies[body].rigid->rotor) {
  for (int k = 0; k < 4; ++k) dofs_.push_back(at.mesh.attitudes[body] + k);
  if (!at.structure.field) return;
  rate_ = at.structure.field->rate;
  radial_ = at.structure.field->radial.value_or(radial_);
}

void RigidInertia::add_force(const MeshedBeams<3>&, const State& state,
                             Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const Eigen::Vector4d p = state.q.segment<4>(dofs_[0]), v = state.v.segment<4>(dofs_[0]),
                        a = state.a.segment<4>(dofs_[0]);
  dynamics.segment<4>(dofs_[0]) += force<double>(p, v, a, state.load);
}

Eigen::Matrix4d RigidInertia::tangent(const State& state, const TangentWeights& w) const {
  using T = Dual<4>;
  using Quaternion = attitude::Quaternion<T>;
  // Variables of which q, v and a are these multiples.
  const auto weighted = [&](const Eigen::VectorXd& of, double weight) {
    Quaternion x;
    for (int k = 0; k < 4; ++k) x[k] = T::variable(of[dofs_[k]], k, weight);
    return x;
  };
  const Quaternion f = force<T>(weighted(state.q, w.stiffness), weighted(state.v, w.damping),
                                weighted(state.a, w.mass), state.load);
  Eigen::Matrix4d K;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) K(i, j) = f[i].d[j];
  return K;
}

void RigidInertia::add_energy(const MeshedBeams<3>&, const State& state, SystemEnergy& sum) const {
  const Eigen::Vector4d p = state.q.segment<4>(dofs_[0]), v = state.v.segment<4>(dofs_[0]);
  const Eigen::Vector3d spin = 2 * attitude::half_spin<double>(p, v);
  sum.kinetic += spin.dot(inertia_ * spin) / 2;
  const Eigen::Vector3d of_frame = attitude::turned_back<double>(p, rate_),
                        radial = attitude::turned_back<double>(p, radial_);
  sum.gravity +=
      (3 * rate_.squaredNorm() * radial.dot(inertia_ * radial) - of_frame.dot(inertia_ * of_frame)) / 2;
}

void RigidInertia::add_momentum_in(const Mesh& mesh, const State& state,
                                   Eigen::Ref<Eigen::VectorXd> p) const {
  const int first = mesh.attitudes[body_];
  const Eigen::Vector4d at = state.q.segment<4>(dofs_[0]), v = state.v.segment<4>(dofs_[0]);
  p.segment<4>(first) +=
      2 * attitude::from_moment<double>(at, inertia_ * (2 * attitude::half_spin<double>(at, v)));
}

}  // namespace nurbeam
