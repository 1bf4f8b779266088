#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/drawn_coordinates.h"
#include "fem/mesh/mesh_elements.h"
#include "fem/structure/carried_body.h"

namespace nurbeam {

/// A body that is where its carrier is: r - r_carrier = (1 - load) (r - r_carrier)_drawn, D rows. The force
/// on the body is minus its multipliers, that on the carrier the multipliers.
template <int D>
class BodyOnBody {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  BodyOnBody(const MeshedBeams<D>& at, const CarriedBody& carried)
      : carried_(carried),
        away_((drawn_place(at.structure, Grip::on_body(carried.body)) -
               drawn_place(at.structure, Grip::on_body(carried.carrier)))
                  .template head<D>()) {
    for (const int body : {carried.body, carried.carrier})
      for (int d = 0; d < D; ++d) dofs_.push_back(at.mesh.bodies[body] + d);
  }

  static constexpr ConstraintOffers offers{.linear = true, .on_body = true};
  static constexpr int rows = D;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>&, const State& state,
                           const typename ConstraintTerms<D>::Multipliers*) const {
    ConstraintTerms<D> terms(rows, false);
    terms.value = state.q.segment<D>(dofs_[0]) - state.q.segment<D>(dofs_[D]) - (1 - state.load) * away_;
    terms.gradient.template leftCols<D>().diagonal().setOnes();
    terms.gradient.template middleCols<D>(D).diagonal().setConstant(-1);
    return terms;
  }
  /// The force on a body [N].
  Vector on_body(int body, const State&, const typename ConstraintTerms<D>::Multipliers& y) const {
    if (body == carried_.body) return -y;
    return body == carried_.carrier ? Vector(y) : Vector(Vector::Zero());
  }

 private:
  CarriedBody carried_;
  Vector away_;  // [m]
  std::vector<int> dofs_;
};

template <int D, class Add>
void bind(const CarriedBody& carried, const MeshedBeams<D>& at, const Eigen::VectorXd&, Add&& add) {
  add(BodyOnBody<D>(at, carried));
}

}  // namespace nurbeam
