#pragma once
#include <stdexcept>
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/grip_position.h"
#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// A body, or a place of one, at a node that a beam keeps: x - r = 0, 3 rows. The force on the body is minus
/// its multipliers.
class BodyAtPlace {
 public:
  BodyAtPlace(const MeshedBeams<3>& at, int body, const Grip& place) : body_(body) {
    const int r = *grip_position(at.structure, at.mesh, place, "the joint of a body");
    for (const int first : {at.mesh.bodies[body], r})
      for (int d = 0; d < 3; ++d) dofs_.push_back(first + d);
  }

  static constexpr ConstraintOffers offers{.linear = true, .on_body = true};
  static constexpr int rows = 3;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state,
                           const ConstraintTerms<3>::Multipliers*) const {
    ConstraintTerms<3> terms(rows, false);
    terms.value = state.q.segment<3>(dofs_[0]) - state.q.segment<3>(dofs_[3]);
    terms.gradient.leftCols<3>().diagonal().setOnes();
    terms.gradient.middleCols<3>(3).diagonal().setConstant(-1);
    return terms;
  }
  /// The force on a body [N].
  Eigen::Vector3d on_body(int body, const State&, const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return body == body_ ? Eigen::Vector3d(-y) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }

 private:
  int body_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
