#include "fem/forces/stored_rope.h"

#include <cmath>

#include "fem/forces/field_on_point.h"

namespace nurbeam {

template <int D>
StoredRope<D>::StoredRope(const MeshedBeams<D>& at, int rider) : rider_(rider) {
  const Rider& mouth = at.structure.riders[rider];
  const Beam& beam = at.structure.beam_of(mouth);
  const Reel& reel = *mouth.reel;
  const bool is_drum = reel.feed == Reel::Feed::drum;
  body_ = mouth.body;
  place_ = at.mesh.riders[rider].place;
  r_ = at.mesh.bodies[mouth.body];
  slope_ = at.mesh.nodes[mouth.beam][at.mesh.riders[rider].node].slope_left;
  rho_ = beam.properties.mass_per_length;
  sense_ = reel.sense();
  end_ = reel.at_start ? beam.curve.start() : beam.curve.end();
  turning_ = is_drum ? rho_ * reel.stretch * reel.stretch : 0;
  pickup_ = is_drum ? 0 : rho_ * (reel.pickup - 0.5);
  strain_energy_ = reel.strain_energy;
  dofs_.push_back(place_);
  for (const int first : {r_, slope_})
    for (int d = 0; d < D; ++d) dofs_.push_back(first + d);
}

template <int D>
double StoredRope<D>::resistance(const State& state) const {
  const double v = state.v[place_];
  return -pickup_ * state.q.segment<D>(slope_).squaredNorm() * v * std::abs(v);
}

template <int D>
typename StoredRope<D>::Vector StoredRope<D>::force_on_mouth(const MeshedBeams<D>& at,
                                                             const State& state) const {
  const Vector g = state.load * at.structure.gravity.template head<D>();
  return rho_ * length(state) * (g - state.a.segment<D>(r_) + field_on_point<D>(at.structure, state, r_)) -
         rho_ * sense_ * state.v[place_] * state.v.segment<D>(r_);
}

template <int D>
void StoredRope<D>::add_force(const MeshedBeams<D>& at, const State& state,
                              Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const Vector g = state.load * at.structure.gravity.template head<D>();
  const double v = state.v[place_];
  dynamics[place_] +=
      turning_ * (length(state) * state.a[place_] + sense_ / 2 * v * v) - resistance(state) -
      sense_ * (rho_ * (state.v.segment<D>(r_).squaredNorm() / 2 + g.dot(state.q.segment<D>(r_))) -
                strain_energy_);
  dynamics.segment<D>(r_) -= force_on_mouth(at, state);
}

template <int D>
typename StoredRope<D>::Matrix StoredRope<D>::tangent(const MeshedBeams<D>& at, const State& state,
                                                      const TangentWeights& w) const {
  Matrix K = Matrix::Zero();
  const Vector u = state.v.segment<D>(r_), g = state.load * at.structure.gravity.template head<D>(),
               slope = state.q.segment<D>(slope_);
  const double l = length(state), v = state.v[place_];
  K(0, 0) = w.mass * turning_ * l + w.stiffness * turning_ * sense_ * state.a[place_] +
            w.damping * (turning_ * sense_ * v + 2 * pickup_ * slope.squaredNorm() * std::abs(v));
  K.template block<1, D>(0, 1) = -sense_ * rho_ * (w.damping * u + w.stiffness * g).transpose();
  K.template block<1, D>(0, 1 + D) = 2 * w.stiffness * pickup_ * v * std::abs(v) * slope.transpose();
  K.template block<D, 1>(1, 0) =
      sense_ * rho_ * (w.stiffness * (Vector(state.a.segment<D>(r_)) - g) + w.damping * u);
  K.template block<D, 1>(1, 0) -= w.stiffness * sense_ * rho_ * field_on_point<D>(at.structure, state, r_);
  K.template block<D, D>(1, 1) = rho_ * l * field_tangent<D>(at.structure, state, r_, w);
  K.template block<D, D>(1, 1).diagonal().array() += rho_ * (w.mass * l + w.damping * sense_ * v);
  return K;
}

template <int D>
void StoredRope<D>::add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
  const double l = length(state), v = state.v[place_];
  sum.kinetic += l / 2 * (turning_ * v * v + rho_ * state.v.segment<D>(r_).squaredNorm());
  sum.gravity -= rho_ * l * at.structure.gravity.template head<D>().dot(state.q.segment<D>(r_));
  sum.gravity += rho_ * l * field_potential<D>(at.structure, state, r_);
  sum.spring += strain_energy_ * l;
}

template <int D>
void StoredRope<D>::add_momentum_in(const Mesh& mesh, const State& state,
                                    Eigen::Ref<Eigen::VectorXd> p) const {
  p.segment<D>(mesh.bodies[body_]) += momentum(state);
  const int place = mesh.riders[rider_].place;
  if (place >= 0) p[place] += turning_ * length(state) * state.v[place_];
}

template <int D>
double StoredRope<D>::loss(const MeshedBeams<D>&, const State& from, const State& to) const {
  return -(resistance(from) + resistance(to)) / 2 * (to.q[place_] - from.q[place_]);
}

template <int D>
typename StoredRope<D>::Vector StoredRope<D>::on_body(const MeshedBeams<D>& at, int body,
                                                      const State& state) const {
  return body == body_ ? force_on_mouth(at, state) : Vector(Vector::Zero());
}

template class StoredRope<2>;
template class StoredRope<3>;

}  // namespace nurbeam
