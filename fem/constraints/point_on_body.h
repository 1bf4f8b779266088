#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/attitude.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// A body that is a place of a rigid body, r + A(p) arm - x = 0: 3 rows; coordinates of the point, then of
/// the rigid body and its attitude. The multipliers are the force on the point.
class PointOnBody {
 public:
  PointOnBody(const MeshedBeams<3>& at, int point, const BodyPoint& place)
      : point_(point), carrier_(place.body), arm_(place.arm) {
    for (const int first : {at.mesh.bodies[point], at.mesh.bodies[carrier_]})
      for (int d = 0; d < 3; ++d) dofs_.push_back(first + d);
    for (int k = 0; k < 4; ++k) dofs_.push_back(at.mesh.attitudes[carrier_] + k);
  }

  /// Binds all points of rigid bodies.
  template <int D, class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    if constexpr (D == 3) {
      const std::vector<Body>& bodies = binding.at.structure.bodies;
      for (std::size_t i = 0; i < bodies.size(); ++i)
        if (bodies[i].point_of) add(PointOnBody(binding.at, static_cast<int>(i), *bodies[i].point_of));
    }
  }

  static constexpr ConstraintOffers offers{.force = true, .on_body = true, .body = true};
  static constexpr int rows = 3;
  const std::vector<int>& dofs() const { return dofs_; }
  int body() const { return dofs_[0]; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state,
                           const ConstraintTerms<3>::Multipliers* y) const {
    ConstraintTerms<3> terms(rows, y != nullptr);
    const Eigen::Vector4d p = state.q.segment<4>(dofs_[6]);
    terms.value =
        state.q.segment<3>(dofs_[3]) + attitude::turned<double>(p, arm_) - state.q.segment<3>(dofs_[0]);
    terms.gradient.leftCols<3>().diagonal().setConstant(-1);
    terms.gradient.middleCols<3>(3).diagonal().setOnes();
    terms.gradient.middleCols<4>(6) = attitude::gradient(p, arm_);
    if (y) terms.hessian.block<4, 4>(6, 6) = 2 * attitude::form(*y, arm_);
    return terms;
  }
  /// The force on the point [N].
  Eigen::Vector3d force(const Eigen::Ref<const Eigen::VectorXd>& y) const { return y; }
  /// The force on a body [N].
  Eigen::Vector3d on_body(int body, const State&, const Eigen::Ref<const Eigen::VectorXd>& y) const {
    if (body == point_) return y;
    return body == carrier_ ? Eigen::Vector3d(-y) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }

 private:
  int point_, carrier_;
  Eigen::Vector3d arm_;  // [m]
  std::vector<int> dofs_;
};

}  // namespace nurbeam
