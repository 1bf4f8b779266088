#pragma once
#include <stdexcept>
#include <vector>

#include "fem/forces/energy.h"
#include "fem/forces/field_on_point.h"
#include "fem/forces/force_offers.h"
#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

template <int D>
class BoundPlaceMass;

/// A lumped mass at a place of a beam that keeps its node.
struct PlaceMass {
  int beam;
  double s;            ///< [m]
  double mass;         ///< [kg]
  bool weighs = true;  ///< false: inertia alone, as a mass that hangs over a pulley pulls as a force
  static constexpr bool permanent = true;

  template <int D>
  using Bound = BoundPlaceMass<D>;
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    visit(
        beam, s, [](HomeNode& node) { node.kept = true; });
  }
};

/// A PlaceMass in one mesh.
template <int D>
class BoundPlaceMass {
 public:
  static constexpr ForceOffers offers{
      .force = true, .energy = true, .momentum = true, .momentum_at_place = true};
  using Vector = Eigen::Matrix<double, D, 1>;

  /// Throws std::invalid_argument where the beam has no node at the place.
  BoundPlaceMass(const PlaceMass& mass, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn);

  const std::vector<int>& dofs() const { return dofs_; }
  int beam() const { return mass_.beam; }
  double s() const { return mass_.s; }

  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    Eigen::Matrix<double, D, D> K = mass_.mass * field_tangent<D>(at.structure, state, dofs_[0], w);
    K.diagonal().array() += w.mass * mass_.mass;
    sink.own(K);
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const;
  /// Momentum [kg m/s].
  Vector momentum(const State& state) const { return mass_.mass * state.v.segment<D>(dofs_[0]); }
  /// Adds the generalised momentum for this velocity of the place [m/s].
  void add_momentum_of(const Eigen::Vector3d& velocity, Eigen::Ref<Eigen::VectorXd> p) const {
    p.segment<D>(dofs_[0]) += mass_.mass * velocity.head<D>();
  }

 private:
  Vector weight(const MeshedBeams<D>& at) const;

  PlaceMass mass_;
  std::vector<int> dofs_;
};

extern template class BoundPlaceMass<2>;
extern template class BoundPlaceMass<3>;

}  // namespace nurbeam
