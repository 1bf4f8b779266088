#pragma once
#include <vector>

#include "fem/forces/energy.h"
#include "fem/forces/force_offers.h"
#include "fem/mesh/binding.h"
#include "fem/mesh/stop_distance.h"

namespace nurbeam {

/// The force of a stop with a buffer on its coordinates (StopDistance): max(0, k x + c dx/dt) for x = -d > 0.
///
/// A body at the buffer presses from the first moment of the step, as State::memory tells. In the trials of a
/// step the force may then fall below 0; the step ends where it comes to 0. If it were cut off at 0, a damper
/// that is stiff against the step would have two solutions, and one of them throws the body back.
template <int D>
class BufferForce {
 public:
  static constexpr ForceOffers offers{
      .force = true, .energy = true, .loss = true, .memory = true, .on_body = true, .damper = true};
  BufferForce(const MeshedBeams<D>& at, int stop);

  /// Binds the forces of all buffers whose bodies are on their beams.
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const MeshedBeams<D>& at = binding.at;
    for (int i = 0; i < static_cast<int>(at.structure.stops.size()); ++i)
      if (at.structure.stops[i].buffer && is_in_place(at.mesh, at.structure.stops[i]))
        add(BufferForce(at, i));
  }

  const std::vector<int>& dofs() const { return distance_.dofs(); }
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    sink.own(tangent(at, state, w));
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const;
  double loss(const MeshedBeams<D>& at, const State& from, const State& to) const;
  /// The force on a body [N].
  Eigen::Matrix<double, D, 1> on_body(const MeshedBeams<D>& at, int body, const State& state) const {
    return distance_.on_body(body, state.q, force(at, state)).template head<D>();
  }
  bool is_damper(const MeshedBeams<D>& at) const { return stop(at).buffer->damping > 0; }
  void commit(const MeshedBeams<D>& at, const State& state, Eigen::VectorXd& memory) const;

 private:
  const Stop& stop(const MeshedBeams<D>& at) const { return at.structure.stops[stop_]; }
  double pressed_in(const State& state) const { return -distance_.value(state.q); }
  double force(const MeshedBeams<D>& at, const State& state) const;
  double stored(const MeshedBeams<D>& at, const State& state) const;
  StopDistance::Matrix tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w) const;

  int stop_;
  StopDistance distance_;
};

extern template class BufferForce<2>;
extern template class BufferForce<3>;

}  // namespace nurbeam
