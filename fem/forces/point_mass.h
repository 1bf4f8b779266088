#pragma once
#include <vector>

#include "fem/forces/energy.h"
#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// Inertia and weight of one body.
template <int D>
class PointMass {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  PointMass(const MeshedBeams<D>& at, int body) : mass_(at.structure.bodies[body].mass) {
    for (int d = 0; d < D; ++d) dofs_.push_back(at.mesh.bodies[body] + d);
  }

  const std::vector<int>& dofs() const { return dofs_; }

  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const {
    const Vector gravity = state.load * at.structure.gravity.template head<D>();
    dynamics.segment<D>(dofs_[0]) += mass_ * (state.a.segment<D>(dofs_[0]) - gravity);
  }
  template <class Sink>
  void add_tangent(const MeshedBeams<D>&, const State&, const TangentWeights& w, Sink&& sink) const {
    sink.own(Eigen::Matrix<double, D, D>(Vector::Constant(w.mass * mass_).asDiagonal()));
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
    sum.kinetic += mass_ * state.v.segment<D>(dofs_[0]).squaredNorm() / 2;
    sum.gravity -= mass_ * at.structure.gravity.template head<D>().dot(state.q.segment<D>(dofs_[0]));
  }
  /// [kg m/s].
  Vector momentum(const State& state) const { return mass_ * state.v.segment<D>(dofs_[0]); }

 private:
  double mass_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
