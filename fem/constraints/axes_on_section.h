#pragma once
#include <array>
#include <optional>
#include <type_traits>
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/followed_section.h"
#include "fem/constraints/guide_section.h"
#include "fem/mesh/attitude.h"
#include "fem/mesh/point_action.h"
#include "fem/structure/body_joint.h"

namespace nurbeam {

/// The attitude of a rigid body that runs along a beam goes by the section where it is (FollowedNode,
/// FollowedPoint, GuideSection): c_k . b_k = 0, N rows, with an axis c_k of the section and one b_k of the
/// body; coordinates of the section, then of the attitude.
template <class Section, int N>
class AxesOnSection {
 public:
  AxesOnSection(const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, int rider)
      : section_(at, drawn, rider) {
    const Rider& of = at.structure.riders[rider];
    std::copy_n(followed_pairs(at.structure, of).begin(), N, pairs_.begin());
    dofs_.assign(section_.dofs().begin(), section_.dofs().end());
    const int p = at.mesh.attitudes[at.structure.turning_body(of)];
    for (int k = 0; k < 4; ++k) dofs_.push_back(p + k);
  }

  static constexpr ConstraintOffers offers{.action = true};
  static constexpr int rows = N;
  const std::vector<int>& dofs() const { return dofs_; }

  /// The couple of the body on the beam, where the body is carried as a point of it.
  std::optional<PointAction> action(const MeshedBeams<3>& at, const State& state,
                                    const ConstraintTerms<3>::Multipliers& y) const {
    if constexpr (!std::is_same_v<Section, FollowedPoint>) return std::nullopt;
    const auto x = section_.coordinates(at, state.q);
    const SectionTriad<double> triad = section_.here(at, x).template triad<double>(x);
    PointAction action{.element = element(), .s = x[Section::size - 1]};
    for (int k = 0; k < N; ++k)
      action.couple += y[k] * attitude::turned<double>(attitude_in(state), pairs_[k][1])
                                  .cross(Eigen::Vector3d(triad.matrix() * pairs_[k][0]));
    return action;
  }

  ConstraintTerms<3> terms(const MeshedBeams<3>& at, const State& state,
                           const ConstraintTerms<3>::Multipliers* y) const {
    constexpr int n = Section::size;
    ConstraintTerms<3> terms(rows, y != nullptr);
    const auto x = section_.coordinates(at, state.q);
    const auto& here = section_.here(at, x);
    const Eigen::Vector4d p = attitude_in(state);
    const auto once = twist::variables<n, double>(x);
    const Eigen::Matrix<Dual<n>, 3, 3> triad = here.template triad<Dual<n>>(once).matrix();
    for (int k = 0; k < N; ++k) {
      const auto& [c, b] = pairs_[k];
      const Eigen::Matrix<double, 3, 4> by_body = attitude::gradient(p, b);
      const Eigen::Vector3d v = attitude::turned<double>(p, b);
      const Vector3<Dual<n>> axis = triad * c.template cast<Dual<n>>();
      const Eigen::Vector3d u(axis[0].value, axis[1].value, axis[2].value);
      Eigen::Matrix<double, 3, n> by_section;
      for (int i = 0; i < n; ++i)
        for (int d = 0; d < 3; ++d) by_section(d, i) = axis[d].d[i];
      terms.value[k] = u.dot(v);
      terms.gradient.template block<1, n>(k, 0) = v.transpose() * by_section;
      terms.gradient.template block<1, 4>(k, n) = u.transpose() * by_body;
      if (!y) continue;
      const Eigen::Matrix<double, n, 4> both = (*y)[k] * by_section.transpose() * by_body;
      terms.hessian.template block<n, 4>(0, n) += both;
      terms.hessian.template block<4, n>(n, 0) += both.transpose();
      terms.hessian.template block<4, 4>(n, n) += 2 * (*y)[k] * attitude::form(u, b);
    }
    if (y) add_bend(here, once, p, *y, terms);
    return terms;
  }

 private:
  using Coordinates = Eigen::Matrix<Dual<Section::size>, Section::size, 1>;

  int element() const {
    if constexpr (std::is_same_v<Section, FollowedPoint>) return section_.element();
    return -1;
  }
  Eigen::Vector4d attitude_in(const State& state) const { return state.q.segment<4>(dofs_[Section::size]); }

  // Second derivatives of the section's axes.
  template <class Here>
  void add_bend(const Here& here, const Coordinates& once, const Eigen::Vector4d& p,
                const ConstraintTerms<3>::Multipliers& y, ConstraintTerms<3>& terms) const {
    constexpr int n = Section::size;
    using T = Dual<n, Dual<n>>;
    const Eigen::Matrix<T, 3, 3> triad = here.template triad<T>(twist::variables<n, Dual<n>>(once)).matrix();
    for (int k = 0; k < N; ++k) {
      const Eigen::Vector3d v = y[k] * attitude::turned<double>(p, pairs_[k][1]);
      const Vector3<T> axis = triad * pairs_[k][0].template cast<T>();
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          for (int d = 0; d < 3; ++d) terms.hessian(i, j) += v[d] * axis[d].d[i].d[j];
    }
  }

  Section section_;
  std::array<AxisPair, N> pairs_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
