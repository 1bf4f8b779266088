#pragma once
#include <vector>

#include "fem/forces/energy.h"
#include "fem/forces/force_offers.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// Inertia and weight of one body.
template <int D>
class PointMass {
 public:
  static constexpr ForceOffers offers{
      .force = true, .energy = true, .momentum = true, .has_constant_inertia = true, .is_body = true};
  using Vector = Eigen::Matrix<double, D, 1>;

  PointMass(const MeshedBeams<D>& at, int body) : mass_(at.structure.bodies[body].mass) {
    for (int d = 0; d < D; ++d) dofs_.push_back(at.mesh.bodies[body] + d);
  }

  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    for (int body = 0; body < static_cast<int>(binding.at.structure.bodies.size()); ++body)
      add(PointMass(binding.at, body));
  }

  const std::vector<int>& dofs() const { return dofs_; }

  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>&, const State&, const TangentWeights& w, Sink&& sink) const {
    sink.own(tangent(w));
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const;
  /// Momentum [kg m/s].
  Vector momentum(const State& state) const;

 private:
  Eigen::Matrix<double, D, D> tangent(const TangentWeights& w) const;

  double mass_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
