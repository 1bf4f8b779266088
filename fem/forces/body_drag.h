#pragma once
#include <vector>

#include "fem/forces/force_offers.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// Air drag on a body, F = rho/2 C_d A |w| w with w = wind - velocity. The power F . w is lost; the power F .
/// wind is input from outside.
template <int D>
class BodyDrag {
 public:
  static constexpr ForceOffers offers{.force = true, .work = true, .loss = true, .on_body = true};
  using Vector = Eigen::Matrix<double, D, 1>;

  BodyDrag(const MeshedBeams<D>& at, int body);

  /// Binds the drag of all bodies on which the air pulls.
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const Structure& structure = binding.at.structure;
    for (int body = 0; body < static_cast<int>(structure.bodies.size()); ++body)
      if (structure.air.density * structure.bodies[body].drag_area > 0) add(BodyDrag(binding.at, body));
  }

  const std::vector<int>& dofs() const { return dofs_; }
  /// The force of the air on the body [N].
  Vector force(const MeshedBeams<D>& at, const State& state) const;
  /// The force on body number `body` [N].
  Vector on_body(const MeshedBeams<D>& at, int body, const State& state) const {
    return body == body_ ? force(at, state) : Vector::Zero();
  }

  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.damping != 0) sink.own(tangent(at, state, w));
  }
  double loss(const MeshedBeams<D>& at, const State& from, const State& to) const;
  double work(const MeshedBeams<D>& at, const State& from, const State& to) const;

 private:
  Vector relative_velocity(const MeshedBeams<D>& at, const State& state) const;
  Eigen::Matrix<double, D, D> tangent(const MeshedBeams<D>& at, const State& state,
                                      const TangentWeights& w) const;
  Vector mean_force(const MeshedBeams<D>& at, const State& from, const State& to) const;

  int body_;
  double factor_;  // rho/2 C_d A [kg/m]
  std::vector<int> dofs_;
};

extern template class BodyDrag<2>;
extern template class BodyDrag<3>;

}  // namespace nurbeam
