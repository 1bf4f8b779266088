#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/forces/point_load.h"
#include "fem/mesh/mesh_elements.h"
#include "fem/time_table.h"

namespace nurbeam {

/// A dead load along a whole beam. Elements carry its even part; where it is uneven, forces at places that
/// are so close that the beam does not tell them from a load along it add the rest.
struct LineLoad {
  static constexpr ForceOffers offers{
      .force = true, .per_length = true, .work = true, .actions = true, .has_constant_inertia = true};
  /// Of the uneven part, the force at a place over `value`.
  struct Share {
    double s, length;  ///< [m], [m]
    bool operator==(const Share&) const = default;
  };

  int beam = 0;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< [N/m] of reference arc length
  TimeTable time = {};                              ///< factor
  double even = 1;                                  ///< part of `value` that is everywhere
  std::vector<Share> uneven = {};

  /// The even load on a beam at time t, with State::load = 1 [N/m]: elements carry it.
  Eigen::Vector3d per_length(int on_beam, double t) const;
  /// Work between two states on one mesh [J]: the mean force over the displacement.
  template <int D>
  double work(const MeshedBeams<D>& at, const State& from, const State& to) const;
  template <int D>
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const {
    for (const Share& share : uneven) at_place(share, state.t).add_force(at, state, dynamics);
  }
  template <int D, class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    for (const Share& share : uneven) at_place(share, state.t).add_tangent(at, state, w, sink);
  }
  template <int D>
  void add_actions(const MeshedBeams<D>& at, const State& state, std::vector<PointAction>& actions) const {
    for (const Share& share : uneven) at_place(share, state.t).add_actions(at, state, actions);
  }

 private:
  PointLoad at_place(const Share& share, double t) const;
};

}  // namespace nurbeam
