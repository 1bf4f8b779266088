#pragma once
#include <vector>

#include "fem/forces/energy.h"
#include "fem/forces/force_offers.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// Inertia of a rigid body against turning, in the coordinates p of its attitude: with its spin
/// w = 2 G(p) dp/dt along its own axes,
///   2 G' (J dw/dt + w x (J w + h)) + c p (p.d2p/dt2 + dp/dt.dp/dt), c = 4/3 tr J,
/// h the angular momentum of a rotor. The part along p makes the mass matrix regular; it vanishes where the
/// length of p stays. In a frame that turns at W, w + A'W stands for w, and on a circular orbit the gradient
/// of gravity adds 3 W^2 x x J x for the direction x away from what is orbited, along own axes.
class RigidInertia {
 public:
  static constexpr ForceOffers offers{.force = true, .energy = true, .carried_momentum = true};

  RigidInertia(const MeshedBeams<3>& at, int body);

  /// Binds that of all rigid bodies.
  template <int D, class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    if constexpr (D == 3)
      for (std::size_t body = 0; body < binding.at.structure.bodies.size(); ++body)
        if (binding.at.mesh.attitudes[body] >= 0) add(RigidInertia(binding.at, static_cast<int>(body)));
  }

  const std::vector<int>& dofs() const { return dofs_; }

  void add_force(const MeshedBeams<3>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<3>&, const State& state, const TangentWeights& w, Sink&& sink) const {
    sink.own(tangent(state, w));
  }
  void add_energy(const MeshedBeams<3>& at, const State& state, SystemEnergy& sum) const;
  /// Adds 2 G' J w.
  void add_momentum_in(const Mesh& mesh, const State& state, Eigen::Ref<Eigen::VectorXd> p) const;

 private:
  Eigen::Matrix4d tangent(const State& state, const TangentWeights& w) const;
  template <class T>
  Eigen::Matrix<T, 4, 1> force(const Eigen::Matrix<T, 4, 1>& p, const Eigen::Matrix<T, 4, 1>& v,
                               const Eigen::Matrix<T, 4, 1>& a, double load) const;

  int body_;
  Eigen::Matrix3d inertia_;                           // J [kg m^2]
  Eigen::Vector3d rotor_;                             // h [N m s]
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();    // W of the frame [rad/s]
  Eigen::Vector3d radial_ = Eigen::Vector3d::Zero();  // x, 0 without a gradient of gravity
  std::vector<int> dofs_;
};

}  // namespace nurbeam
