#include "fem/forces/buffer_force.h"

#include <algorithm>

#include "fem/forces/memory.h"
#include "fem/mesh/stop_distance.h"

namespace nurbeam {

template <int D>
BufferForce<D>::BufferForce(const MeshedBeams<D>& at, int stop)
    : stop_(stop), distance_(at.structure, at.mesh, at.structure.stops[stop]) {}

template <int D>
double BufferForce<D>::force(const MeshedBeams<D>& at, const State& state) const {
  const double x = pressed_in(state);
  const BufferContact contact = buffer_contact(at.mesh.memory, state.memory, stop_);
  const Buffer& buffer = *stop(at).buffer;
  // A body that begins a step away from the buffer meets no damper in this step, so nothing jumps within it.
  if (contact == BufferContact::away) return std::max(0.0, buffer.stiffness * x);
  const double N = buffer.stiffness * x - buffer.damping * distance_.rate(state.q, state.v);
  return contact == BufferContact::pressing ? N : std::max(0.0, N);
}

template <int D>
void BufferForce<D>::add_force(const MeshedBeams<D>& at, const State& state,
                               Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const StopDistance::Vector push = force(at, state) * distance_.gradient(state.q);
  for (Eigen::Index i = 0; i < push.size(); ++i)
    if (dofs()[i] >= 0) dynamics[dofs()[i]] -= push[i];
}

template <int D>
StopDistance::Matrix BufferForce<D>::tangent(const MeshedBeams<D>& at, const State& state,
                                             const TangentWeights& w) const {
  const StopDistance::Vector W = distance_.gradient(state.q);
  const double N = force(at, state);
  if (N == 0) return StopDistance::Matrix::Zero(W.size(), W.size());
  const Buffer& buffer = *stop(at).buffer;
  const bool away = buffer_contact(at.mesh.memory, state.memory, stop_) == BufferContact::away;
  const double c = away ? 0 : buffer.damping;
  const StopDistance::Matrix H = distance_.hessian(state.q);
  return (w.stiffness * buffer.stiffness + w.damping * c) * W * W.transpose() +
         w.stiffness * (c * W * (H * distance_.own(state.v)).transpose() - N * H);
}

template <int D>
double BufferForce<D>::stored(const MeshedBeams<D>& at, const State& state) const {
  const double x = std::max(0.0, pressed_in(state));
  return stop(at).buffer->stiffness * x * x / 2;
}

template <int D>
void BufferForce<D>::add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
  sum.spring += stored(at, state);
}

template <int D>
double BufferForce<D>::loss(const MeshedBeams<D>& at, const State& from, const State& to) const {
  const double work = (force(at, from) + force(at, to)) / 2 * (pressed_in(from) - pressed_in(to));
  return stored(at, from) - stored(at, to) - work;
}

template <int D>
void BufferForce<D>::commit(const MeshedBeams<D>& at, const State& state, Eigen::VectorXd& memory) const {
  if (memory.size() == 0) return;
  const BufferContact contact = buffer_contact(at.mesh.memory, memory, stop_);
  const bool let_go = contact == BufferContact::let_go;
  if (contact == BufferContact::away || !(pressed_in(state) > 0))
    set_buffer_contact(at.mesh.memory, memory, stop_, BufferContact::away);
  else if (force(at, state) > 0 && !(let_go && distance_.rate(state.q, state.v) >= 0))
    set_buffer_contact(at.mesh.memory, memory, stop_, BufferContact::pressing);
}

template class BufferForce<2>;
template class BufferForce<3>;

}  // namespace nurbeam
