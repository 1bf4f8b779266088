#pragma once
#include <array>
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/attitude.h"
#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// A body slides along a straight line of space or of a rigid body: V_k . (x - r) - v_k . arm = 0, 2 rows.
/// v_1 and v_2 are across the line, V_k = A(p) v_k as the rigid body has them at present, and arm leads from
/// its centre r to the line; coordinates of the body, then of r and p. For a line of space r is the origin.
class PointOnLine {
 public:
  /// `carrier`: the rigid body, -1 for space.
  PointOnLine(const MeshedBeams<3>& at, int body, int carrier, const Eigen::Vector3d& arm,
              const Eigen::Vector3d& along)
      : body_(body), carrier_(carrier), arm_(arm) {
    const Eigen::Vector3d u = along.normalized(), v = u.unitOrthogonal();
    across_ = {v, u.cross(v)};
    for (int d = 0; d < 3; ++d) dofs_.push_back(at.mesh.bodies[body] + d);
    if (carrier < 0) return;
    for (int d = 0; d < 3; ++d) dofs_.push_back(at.mesh.bodies[carrier] + d);
    for (int k = 0; k < 4; ++k) dofs_.push_back(at.mesh.attitudes[carrier] + k);
  }

  static constexpr ConstraintOffers offers{.force = true, .on_body = true};
  static constexpr int rows = 2;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state,
                           const ConstraintTerms<3>::Multipliers* y) const {
    ConstraintTerms<3> terms(rows, y != nullptr);
    const Eigen::Vector3d away = state.q.segment<3>(dofs_[0]) - centre(state);
    for (int k = 0; k < rows; ++k) {
      const Eigen::Vector3d across = turned(state, across_[k]);
      terms.value[k] = across.dot(away) - across_[k].dot(arm_);
      terms.gradient.row(k).head<3>() = across;
      if (carrier_ < 0) continue;
      const Eigen::Vector4d p = state.q.segment<4>(dofs_[6]);
      const Eigen::Matrix<double, 3, 4> J = attitude::gradient(p, across_[k]);
      terms.gradient.row(k).segment<3>(3) = -across;
      terms.gradient.row(k).segment<4>(6) = away.transpose() * J;
      if (!y) continue;
      const double weight = (*y)[k];
      terms.hessian.block<4, 4>(6, 6) += 2 * weight * attitude::form(away, across_[k]);
      for (const int first : {0, 3}) {
        const double sign = first == 0 ? weight : -weight;
        terms.hessian.block<3, 4>(first, 6) += sign * J;
        terms.hessian.block<4, 3>(6, first) += sign * J.transpose();
      }
    }
    return terms;
  }
  /// The force on the body [N].
  Eigen::Vector3d force(const State& state, const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return -y[0] * turned(state, across_[0]) - y[1] * turned(state, across_[1]);
  }
  /// The force on a body [N].
  Eigen::Vector3d on_body(int body, const State& state, const Eigen::Ref<const Eigen::VectorXd>& y) const {
    if (body == body_) return force(state, y);
    return body == carrier_ ? Eigen::Vector3d(-force(state, y)) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }

 private:
  Eigen::Vector3d centre(const State& state) const {
    return carrier_ < 0 ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                        : Eigen::Vector3d(state.q.segment<3>(dofs_[3]));
  }
  Eigen::Vector3d turned(const State& state, const Eigen::Vector3d& a) const {
    return carrier_ < 0 ? a : attitude::turned<double>(state.q.segment<4>(dofs_[6]), a);
  }

  int body_, carrier_;
  Eigen::Vector3d arm_;                    // [m]; of space a point of the line
  std::array<Eigen::Vector3d, 2> across_;  // of length 1
  std::vector<int> dofs_;
};

}  // namespace nurbeam
