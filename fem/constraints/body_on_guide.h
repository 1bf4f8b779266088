#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// A body on a rigid guide, r_0(sigma) = r_body on the drawn curve itself: D rows; coordinates of the body,
/// then sigma. The constraint uses the segment at the place in the plan, continued beyond its ends as far as
/// a step leads.
template <int D>
class BodyOnGuide {
 public:
  BodyOnGuide(const MeshedBeams<D>& at, int rider)
      : curve_(&at.structure.beam_of(at.structure.riders[rider]).curve),
        segment_(curve_->segment_at(at.mesh.plan.places[rider])) {
    const int r = at.mesh.bodies[at.structure.riders[rider].body];
    for (int d = 0; d < D; ++d) dofs_.push_back(r + d);
    dofs_.push_back(at.mesh.riders[rider].place);
  }

  static constexpr ConstraintOffers offers{};
  static constexpr int rows = D;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>&, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    ConstraintTerms<D> terms(rows, y != nullptr);
    const CurvePoint p = curve_->point_in(segment_, state.q[dofs_[D]]);
    terms.value = p.position.template head<D>() - state.q.segment<D>(dofs_[0]);
    terms.gradient.template leftCols<D>().diagonal().setConstant(-1);
    terms.gradient.col(D) = p.tangent.template head<D>();
    if (y) terms.hessian(D, D) = y->dot(p.curvature.template head<D>());
    return terms;
  }

 private:
  const ReferenceCurve* curve_;
  int segment_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
