#pragma once
#include <vector>

#include "fem/forces/energy.h"
#include "fem/forces/force_offers.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// The rope on a reel: the inertia, weight and strain energy of a beam's part that has no elements.
///
/// With the stored length l = +-(s - s_end), the velocity u of the mouth x and rho per reference length it
/// adds to the Lagrangian  1/2 rho stretch^2 l s'^2 (a drum, whose rope moves at the speed of its mouth)
/// + 1/2 rho l |u|^2 + rho l g.x - U_0 l. The end of the element at the mouth has the opposite terms in l, so
/// that rope brings its momentum and energy along when it leaves. From a spool it is drawn at rest, with the
/// loss (iota - 1/2) rho |r_s|^2 |s'|^3 per second.
template <int D>
class StoredRope {
 public:
  static constexpr ForceOffers offers{.force = true,
                                      .energy = true,
                                      .momentum = true,
                                      .carried_momentum = true,
                                      .loss = true,
                                      .on_body = true};
  using Vector = Eigen::Matrix<double, D, 1>;

  StoredRope(const MeshedBeams<D>& at, int rider);

  /// Binds the ropes of all reels that have not let go of their beams.
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const MeshedBeams<D>& at = binding.at;
    for (int j = 0; j < static_cast<int>(at.structure.riders.size()); ++j)
      if (at.structure.riders[j].reel && at.mesh.plan.modes[j] != Carried::free) add(StoredRope(at, j));
  }

  /// Place and position of the mouth, and the slope there.
  const std::vector<int>& dofs() const { return dofs_; }

  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    sink.own(tangent(at, state, w));
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const;
  /// Momentum [kg m/s].
  Vector momentum(const State& state) const { return rho_ * length(state) * state.v.segment<D>(r_); }
  /// Adds the generalised momentum to that of another mesh.
  void add_momentum_in(const Mesh& mesh, const State& state, Eigen::Ref<Eigen::VectorXd> p) const;
  /// Energy lost between two states on one mesh as rope is drawn off a spool [J]: the mean force over the
  /// way.
  double loss(const MeshedBeams<D>& at, const State& from, const State& to) const;
  /// Force on the body at the mouth, by weight and inertia of what is stored [N].
  Vector on_body(const MeshedBeams<D>& at, int body, const State& state) const;

 private:
  using Matrix = Eigen::Matrix<double, 1 + 2 * D, 1 + 2 * D>;
  double length(const State& state) const { return sense_ * (state.q[place_] - end_); }
  /// The force on the place by which a spool resists [N].
  double resistance(const State& state) const;
  Vector force_on_mouth(const MeshedBeams<D>& at, const State& state) const;
  Matrix tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w) const;

  int rider_, body_, place_, r_, slope_;
  double rho_, sense_, end_;
  double turning_;        // of a drum, rho stretch^2 [kg/m]; 0 of a spool
  double pickup_;         // of a spool, rho (iota - 1/2) [kg/m]; 0 of a drum
  double strain_energy_;  // [J/m]
  std::vector<int> dofs_;
};

extern template class StoredRope<2>;
extern template class StoredRope<3>;

}  // namespace nurbeam
