#pragma once
#include <vector>

#include "fem/forces/energy.h"
#include "fem/mesh/connector_axis.h"

namespace nurbeam {

/// The pull of a connector of that stretch e and rate of it, and its derivatives.
struct ConnectorPull {
  double force = 0;    ///< N [N]
  double elastic = 0;  ///< its part k e, whose energy is stored [N]
  double by_stretch = 0, by_rate = 0;

  ConnectorPull(const Connector& connector, double stretch, double rate);
};

/// A connector but a rod, in one mesh.
template <int D>
class Spring {
 public:
  /// `connector` must outlive it.
  Spring(const Connector& connector, const MeshedBeams<D>& at)
      : connector_(&connector), axis_(connector, at.structure, at.mesh) {}

  const std::vector<int>& dofs() const { return axis_.dofs(); }
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>&, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.stiffness != 0 || w.damping != 0) sink.own(tangent(state, w));
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const;

  const Connector& connector() const { return *connector_; }
  /// |d| or n . d [m], and N [N].
  std::pair<double, double> length_and_force(const State& state) const;
  /// What it gives to a body [N].
  Eigen::Matrix<double, D, 1> on_body(int body, const State& state) const;

 private:
  using Matrix = Eigen::Matrix<double, 2 * D, 2 * D>;
  Matrix tangent(const State& state, const TangentWeights& w) const;

  const Connector* connector_;
  ConnectorAxis<D> axis_;
};

extern template class Spring<2>;
extern template class Spring<3>;

}  // namespace nurbeam
