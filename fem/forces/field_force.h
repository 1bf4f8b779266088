#pragma once
#include <vector>

#include "fem/forces/energy.h"
#include "fem/forces/field_on_point.h"
#include "fem/forces/force_offers.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// The forces of a MassField on the elements of all beams, at Gauss points that move with their material.
/// Their potential counts as gravity's; the part that goes with the velocity does no work.
template <int D>
class FieldOnBeams {
 public:
  static constexpr ForceOffers offers{.force = true, .energy = true};

  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    if (binding.at.structure.field) add(FieldOnBeams());
  }

  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.stiffness == 0 && w.damping == 0) return;
    for (const MeshElement<D>& e : at.elements) sink.element(e.index, tangent(at, e, state, w));
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const;

 private:
  ElementMatrix<D> tangent(const MeshedBeams<D>& at, const MeshElement<D>& e, const State& state,
                           const TangentWeights& w) const;
};

extern template class FieldOnBeams<2>;
extern template class FieldOnBeams<3>;

/// The same on the mass of a body.
template <int D>
class FieldOnBody {
 public:
  static constexpr ForceOffers offers{.force = true, .energy = true};

  FieldOnBody(const MeshedBeams<D>& at, int body) : mass_(at.structure.bodies[body].mass) {
    for (int d = 0; d < D; ++d) dofs_.push_back(at.mesh.bodies[body] + d);
  }

  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const std::vector<Body>& bodies = binding.at.structure.bodies;
    for (int body = 0; body < static_cast<int>(bodies.size()); ++body)
      if (binding.at.structure.field && bodies[body].mass > 0) add(FieldOnBody(binding.at, body));
  }

  const std::vector<int>& dofs() const { return dofs_; }
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const {
    dynamics.segment<D>(dofs_[0]) -= mass_ * field_on_point<D>(at.structure, state, dofs_[0]);
  }
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    sink.own(Eigen::Matrix<double, D, D>(mass_ * field_tangent<D>(at.structure, state, dofs_[0], w)));
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
    sum.gravity += mass_ * field_potential<D>(at.structure, state, dofs_[0]);
  }

 private:
  double mass_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
