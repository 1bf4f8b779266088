#pragma once
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/held_place.h"
#include "fem/mesh/point_action.h"
#include "fem/mesh/point_on_beam.h"
#include "fem/mesh/widened.h"

namespace nurbeam {

/// A body on a point of the mesh that moves over the material, r(sigma) = r_body: D rows; coordinates of the
/// element, then of the body, then sigma.
template <int D>
class BodyOnPoint {
 public:
  BodyOnPoint(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, int rider)
      : element_(find_span(at.structure, at.mesh, drawn, at.structure.riders[rider].beam,
                           at.mesh.plan.places[rider])) {
    const auto& dofs = at.elements[element_].dofs;
    dofs_.assign(dofs.begin(), dofs.end());
    const int r = at.mesh.bodies[at.structure.riders[rider].body];
    for (int d = 0; d < D; ++d) dofs_.push_back(r + d);
    dofs_.push_back(at.mesh.riders[rider].place);
  }

  static constexpr ConstraintOffers offers{.action = true};
  static constexpr int rows = D;
  const std::vector<int>& dofs() const { return dofs_; }
  /// The force of the body on the beam.
  PointAction action(const MeshedBeams<D>& at, const State& state,
                     const typename ConstraintTerms<D>::Multipliers& y) const {
    const MeshElement<D>& e = at.elements[element_];
    return {.element = element_,
            .s = e.local(gather<D>(e, state.q), state.q[dofs_.back()]),
            .force = -widened<D>(y)};
  }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    constexpr int n = element_size<D>, place = n + D;
    ConstraintTerms<D> terms(rows, y != nullptr);
    const CurvedPointShape<D> shape = point_shape<D>(at.elements[element_], state.q, state.q[dofs_[place]]);
    const PointField<D> r = shape.position(), rs = shape.slope(), rss = shape.slope_s();
    terms.value = r.value - state.q.segment<D>(dofs_[n]);
    terms.gradient.template leftCols<n>() = r.gradient;
    terms.gradient.template middleCols<D>(n).diagonal().setConstant(-1);
    terms.gradient.col(place) = rs.value;
    if (!y) return terms;
    r.add_hessian(*y, 1, shape.nodes, terms.hessian);
    const Eigen::Matrix<double, n, 1> mixed = rs.gradient.transpose() * *y;
    terms.hessian.template block<n, 1>(0, place) += mixed;
    terms.hessian.template block<1, n>(place, 0) += mixed.transpose();
    terms.hessian(place, place) += y->dot(rss.value);
    return terms;
  }

 private:
  int element_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
