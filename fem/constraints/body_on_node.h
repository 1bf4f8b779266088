#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// A body with coordinates of its own on its moving node, r_node = r_body: D rows; coordinates of the node,
/// then of the body. The multipliers are the beam's force on the body.
template <int D>
class BodyOnNode {
 public:
  BodyOnNode(const MeshedBeams<D>& at, int rider) {
    const Rider& sliding = at.structure.riders[rider];
    const int node = at.mesh.nodes[sliding.beam][at.mesh.riders[rider].node].r;
    for (const int first : {node, at.mesh.bodies[sliding.body]})
      for (int d = 0; d < D; ++d) dofs_.push_back(first + d);
  }

  static constexpr ConstraintOffers offers{.linear = true, .body = true};
  static constexpr int rows = D;
  const std::vector<int>& dofs() const { return dofs_; }
  /// First coordinate of the body.
  int body() const { return dofs_[D]; }

  ConstraintTerms<D> terms(const MeshedBeams<D>&, const State& state,
                           const typename ConstraintTerms<D>::Multipliers*) const {
    ConstraintTerms<D> terms(rows, false);
    terms.value = state.q.segment<D>(dofs_[0]) - state.q.segment<D>(dofs_[D]);
    terms.gradient.template leftCols<D>().diagonal().setOnes();
    terms.gradient.template middleCols<D>(D).diagonal().setConstant(-1);
    return terms;
  }

 private:
  std::vector<int> dofs_;
};

}  // namespace nurbeam
