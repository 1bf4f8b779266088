#pragma once
#include <vector>

#include "fem/forces/energy.h"
#include "fem/forces/force_offers.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// What turns with the beam at the place of a rider, and what drives it: J s'' = F(t) + ..., with the inertia
/// J = I/r^2 of a pulley over which the beam runs and the force F = M/r of its motor.
template <int D>
class PlaceDrive {
 public:
  static constexpr ForceOffers offers{
      .force = true, .energy = true, .carried_momentum = true, .work = true, .has_constant_inertia = true};

  PlaceDrive(const MeshedBeams<D>& at, int rider)
      : inertia_(at.structure.riders[rider].turning_inertia),
        force_(&at.structure.riders[rider].drive_force),
        rider_(rider),
        dofs_{at.mesh.riders[rider].place} {}

  /// Binds the drives of all riders that are on their beams.
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const MeshedBeams<D>& at = binding.at;
    for (int j = 0; j < static_cast<int>(at.structure.riders.size()); ++j) {
      const Rider& rider = at.structure.riders[j];
      const bool has_drive = rider.turning_inertia > 0 || !rider.drive_force.empty();
      if (has_drive && at.mesh.plan.modes[j] != Carried::free) add(PlaceDrive(at, j));
    }
  }

  const std::vector<int>& dofs() const { return dofs_; }

  void add_force(const MeshedBeams<D>&, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const {
    dynamics[dofs_[0]] += inertia_ * state.a[dofs_[0]] - state.load * force(state.t);
  }
  template <class Sink>
  void add_tangent(const MeshedBeams<D>&, const State&, const TangentWeights& w, Sink&& sink) const {
    sink.own(Eigen::Matrix<double, 1, 1>(w.mass * inertia_));
  }
  void add_energy(const MeshedBeams<D>&, const State& state, SystemEnergy& sum) const {
    sum.kinetic += inertia_ * state.v[dofs_[0]] * state.v[dofs_[0]] / 2;
  }
  /// Adds the momentum of what turns to that of another mesh.
  void add_momentum_in(const Mesh& mesh, const State& state, Eigen::Ref<Eigen::VectorXd> p) const {
    const int place = mesh.riders[rider_].place;
    if (place >= 0) p[place] += inertia_ * state.v[dofs_[0]];
  }
  /// Work between two states on one mesh [J]: the mean force over the way.
  double work(const MeshedBeams<D>&, const State& from, const State& to) const {
    return (from.load * force(from.t) + to.load * force(to.t)) / 2 * (to.q[dofs_[0]] - from.q[dofs_[0]]);
  }

 private:
  double force(double t) const { return force_->empty() ? 0 : value_and_slope(*force_, t).first; }

  double inertia_;
  const TimeTable* force_;
  int rider_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
