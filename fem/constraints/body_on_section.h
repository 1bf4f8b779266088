#pragma once
#include <algorithm>
#include <optional>
#include <type_traits>

#include "fem/constraints/body_on_point.h"
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/followed_section.h"

namespace nurbeam {

/// A body at an offset from the axis, in the section that it follows (FollowedNode, FollowedPoint):
/// r + y1 d1 + y2 d2 - r_body = 0, 3 rows. The multipliers are the force on the axis, with the couple e x
/// lambda on the section, e = y1 d1 + y2 d2.
template <class Section>
class BodyOnSection {
 public:
  BodyOnSection(const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, int rider)
      : section_(at, drawn, rider) {
    const Rider& of = at.structure.riders[rider];
    arm_ << of.offset, 0;
    body_ = at.mesh.bodies[of.body];
    if constexpr (on_point) {
      point_.emplace(at, drawn, rider);
      dofs_ = point_->dofs();
    } else {
      const int r = at.mesh.nodes[of.beam][at.mesh.riders[rider].node].r;
      dofs_ = {r, r + 1, r + 2, body_, body_ + 1, body_ + 2};
    }
    for (int i = 0; i < Section::size; ++i) {
      const auto found = std::find(dofs_.begin(), dofs_.end(), section_.dofs()[i]);
      column_[i] = static_cast<int>(found - dofs_.begin());
      if (found == dofs_.end()) dofs_.push_back(section_.dofs()[i]);
    }
  }

  static constexpr ConstraintOffers offers{.curvature = true, .action = true, .body = true};
  static constexpr int rows = 3;
  const std::vector<int>& dofs() const { return dofs_; }
  /// First coordinate of the body.
  int body() const { return body_; }

  /// The force and couple of the body on the beam, where the body is carried as a point.
  std::optional<PointAction> action(const MeshedBeams<3>& at, const State& state,
                                    const Eigen::Vector3d& y) const;

  ConstraintTerms<3> terms(const MeshedBeams<3>& at, const State& state,
                           const ConstraintTerms<3>::Multipliers* y) const;

  /// (3) v . H v of each row, for the velocities v of the constraint's coordinates.
  Eigen::Vector3d curvature(const MeshedBeams<3>& at, const State& state,
                            const Eigen::Matrix<double, ConstraintTerms<3>::size, 1>& v) const;

 private:
  static constexpr bool on_point = std::is_same_v<Section, FollowedPoint>;

  template <class T>
  Vector3<T> arm(const SectionTriad<T>& section) const {
    return arm_[0] * section.d1 + arm_[1] * section.d2;
  }
  void add_arm(const Vector3<Dual<Section::size>>& e, ConstraintTerms<3>& terms) const {
    for (int k = 0; k < 3; ++k) {
      terms.value[k] += e[k].value;
      for (int i = 0; i < Section::size; ++i) terms.gradient(k, column_[i]) += e[k].d[i];
    }
  }
  ConstraintTerms<3> without_offset(const MeshedBeams<3>& at, const State& state,
                                    const ConstraintTerms<3>::Multipliers* y) const {
    if constexpr (on_point) return point_->terms(at, state, y);
    ConstraintTerms<3> terms(rows, y != nullptr);
    terms.value = state.q.segment<3>(dofs_[0]) - state.q.segment<3>(body_);
    terms.gradient.leftCols<3>().setIdentity();
    terms.gradient.middleCols<3>(3) = -Eigen::Matrix3d::Identity();
    return terms;
  }

  Section section_;
  Eigen::Vector3d arm_;
  int body_;
  std::optional<BodyOnPoint<3>> point_;  // where the section is at a point
  std::vector<int> dofs_;
  std::array<int, Section::size> column_{};  // column of each coordinate of the section among dofs_
};

extern template class BodyOnSection<FollowedNode>;
extern template class BodyOnSection<FollowedPoint>;

}  // namespace nurbeam
