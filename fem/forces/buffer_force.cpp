#include "fem/forces/buffer_force.h"

#include <algorithm>

#include "fem/forces/memory.h"
#include "fem/mesh/stop_distance.h"

namespace nurbeam {

template <int D>
BufferForce<D>::BufferForce(const MeshedBeams<D>& at, int stop)
    : stop_(stop), dofs_(places_of_stop(at.mesh, at.structure.stops[stop])) {
  const Stop& of = at.structure.stops[stop];
  by_places_ << of.weight_of_joint(), of.weight_of_other();
}

template <int D>
double BufferForce<D>::pressed_in(const MeshedBeams<D>& at, const State& state) const {
  return -stop_distance(at.mesh, stop(at), state.q);
}

template <int D>
double BufferForce<D>::force(const MeshedBeams<D>& at, const State& state) const {
  const double x = pressed_in(at, state);
  const BufferContact contact = buffer_contact(at.structure, state.memory, stop_);
  const Buffer& buffer = *stop(at).buffer;
  // One that begins a step away has no damper in it: within a step nothing jumps.
  if (contact == BufferContact::away) return std::max(0.0, buffer.stiffness * x);
  const double N = buffer.stiffness * x - buffer.damping * stop_rate(at.mesh, stop(at), state.v);
  return contact == BufferContact::pressing ? N : std::max(0.0, N);
}

template <int D>
void BufferForce<D>::add_force(const MeshedBeams<D>& at, const State& state,
                               Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const double N = force(at, state);
  for (int i = 0; i < 2; ++i)
    if (dofs_[i] >= 0) dynamics[dofs_[i]] -= by_places_[i] * N;
}

template <int D>
Eigen::Matrix2d BufferForce<D>::tangent(const MeshedBeams<D>& at, const State& state,
                                        const TangentWeights& w) const {
  if (force(at, state) == 0) return Eigen::Matrix2d::Zero();
  const Buffer& buffer = *stop(at).buffer;
  const bool away = buffer_contact(at.structure, state.memory, stop_) == BufferContact::away;
  return (w.stiffness * buffer.stiffness + (away ? 0 : w.damping * buffer.damping)) * by_places_ *
         by_places_.transpose();
}

template <int D>
double BufferForce<D>::stored(const MeshedBeams<D>& at, const State& state) const {
  const double x = std::max(0.0, pressed_in(at, state));
  return stop(at).buffer->stiffness * x * x / 2;
}

template <int D>
void BufferForce<D>::add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
  sum.spring += stored(at, state);
}

template <int D>
double BufferForce<D>::loss(const MeshedBeams<D>& at, const State& from, const State& to) const {
  const double work = (force(at, from) + force(at, to)) / 2 * (pressed_in(at, from) - pressed_in(at, to));
  return stored(at, from) - stored(at, to) - work;
}

template <int D>
void BufferForce<D>::commit(const MeshedBeams<D>& at, const State& state, Eigen::VectorXd& memory) const {
  if (memory.size() == 0) return;
  const BufferContact contact = buffer_contact(at.structure, memory, stop_);
  const bool let_go = contact == BufferContact::let_go;
  if (contact == BufferContact::away || !(pressed_in(at, state) > 0))
    set_buffer_contact(at.structure, memory, stop_, BufferContact::away);
  else if (force(at, state) > 0 && !(let_go && stop_rate(at.mesh, stop(at), state.v) >= 0))
    set_buffer_contact(at.structure, memory, stop_, BufferContact::pressing);
}

template class BufferForce<2>;
template class BufferForce<3>;

}  // namespace nurbeam
