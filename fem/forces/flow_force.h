#pragma once
#include "fem/forces/force_offers.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// What a beam that runs along itself at a steady speed v feels in its equilibrium, where
/// Structure::runs_at_rest: by Routh the potential -1/2 rho v^2 |r_s|^2 per length, so that it carries N -
/// rho |r_s| v^2 where it would carry the axial force N at rest.
template <int D>
class FlowForce {
 public:
  static constexpr ForceOffers offers{.force = true};

  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    if (binding.at.structure.runs_at_rest) add(FlowForce());
  }

  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  /// Exact but for places of moving nodes, which drives hold.
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.stiffness == 0) return;
    for (const MeshElement<D>& e : at.elements)
      if (at.structure.beams[e.span->beam].flow != 0)
        sink.element(e.index, tangent(at, e, state, w.stiffness));
  }

 private:
  ElementMatrix<D> tangent(const MeshedBeams<D>& at, const MeshElement<D>& e, const State& state,
                           double weight) const;
};

extern template class FlowForce<2>;
extern template class FlowForce<3>;

}  // namespace nurbeam
