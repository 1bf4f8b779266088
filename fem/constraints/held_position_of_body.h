#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/drawn_coordinates.h"
#include "fem/mesh/mesh_elements.h"
#include "fem/structure/held_body.h"

namespace nurbeam {

/// A body held at a point, r_body = r_drawn + load (position - r_drawn): D rows. The force on the body is
/// minus its multipliers; for an eyelet it is the force on the beam that runs through it.
template <int D>
class HeldPositionOfBody {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  HeldPositionOfBody(const MeshedBeams<D>& at, const HeldBody& held)
      : body_(held.body),
        drawn_(drawn_place(at.structure, Grip::on_body(held.body)).template head<D>()),
        away_(held.position.template head<D>() - drawn_) {
    const int r = at.mesh.bodies[held.body];
    for (int d = 0; d < D; ++d) dofs_.push_back(r + d);
  }

  static constexpr ConstraintOffers offers{.linear = true, .on_body = true};
  static constexpr int rows = D;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>&, const State& state,
                           const typename ConstraintTerms<D>::Multipliers*) const {
    ConstraintTerms<D> terms(rows, false);
    terms.value = state.q.segment<D>(dofs_[0]) - drawn_ - state.load * away_;
    terms.gradient.template leftCols<D>().diagonal().setOnes();
    return terms;
  }
  /// The force on a body [N].
  Vector on_body(int body, const State&, const typename ConstraintTerms<D>::Multipliers& y) const {
    return body == body_ ? Vector(-y) : Vector(Vector::Zero());
  }

 private:
  int body_;
  Vector drawn_, away_;
  std::vector<int> dofs_;
};

template <int D, class Add>
void bind(const HeldBody& held, const MeshedBeams<D>& at, const Eigen::VectorXd&, Add&& add) {
  add(HeldPositionOfBody<D>(at, held));
}

}  // namespace nurbeam
