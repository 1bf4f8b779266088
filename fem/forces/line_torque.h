#pragma once
#include <vector>

#include "fem/forces/force_offers.h"
#include "fem/mesh/mesh_elements.h"
#include "fem/time_table.h"

namespace nurbeam {

/// A torque about the present tangent along a whole beam with torsion.
struct LineTorque {
  static constexpr ForceOffers offers{.force = true, .work = true, .on_element = true};
  int beam = 0;
  double value = 0;     ///< [N m/m] of reference arc length
  TimeTable time = {};  ///< factor

  /// The torque along the beam, with its factors of time and of State::load [N m/m].
  double per_length(const State& state) const {
    return state.load * value_and_slope(time, state.t).first * value;
  }
  /// Generalised force on an element of the beam, and its derivative in q.
  TwistLayout::Coordinates on_element(const MeshElement<3>& e, const State& state) const;
  void add_force(const MeshedBeams<3>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<3>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.stiffness == 0) return;
    for (int i = at.mesh.first_span[beam]; i < at.mesh.first_span[beam + 1]; ++i)
      sink.twist(i, -w.stiffness * gradient(at.elements[i], state));
  }
  /// Work between two states on one mesh [J]: the mean power over the time.
  double work(const MeshedBeams<3>& at, const State& from, const State& to) const;
  // A beam in the plane has no torsion.
  void add_force(const MeshedBeams<2>&, const State&, Eigen::Ref<Eigen::VectorXd>) const {}
  template <class Sink>
  void add_tangent(const MeshedBeams<2>&, const State&, const TangentWeights&, Sink&&) const {}
  double work(const MeshedBeams<2>&, const State&, const State&) const { return 0; }

 private:
  TwistLayout::Matrix gradient(const MeshElement<3>& e, const State& state) const;
};

}  // namespace nurbeam
