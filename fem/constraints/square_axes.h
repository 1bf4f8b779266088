#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/turning_axes.h"
#include "fem/structure/body_joint.h"

namespace nurbeam {

/// N pairs of axes of two things stay square: a_k . b_k = 0, one row for each pair, with a_k an axis of the
/// first end and b_k one of the second; coordinates of the first end, then of the second.
template <int N>
class SquareAxes {
 public:
  SquareAxes(const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, const std::array<Grip, 2>& ends,
             const std::vector<AxisPair>& pairs)
      : ends_{TurningAxes(at, drawn, ends[0]), TurningAxes(at, drawn, ends[1])} {
    std::copy_n(pairs.begin(), N, pairs_.begin());
    for (const TurningAxes& end : ends_) dofs_.insert(dofs_.end(), end.dofs().begin(), end.dofs().end());
  }

  static constexpr ConstraintOffers offers{.couple = true};
  static constexpr int rows = N;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state,
                           const ConstraintTerms<3>::Multipliers* y) const {
    return terms_of(state, pairs_, y);
  }
  /// The couple on the first end for its multipliers [N m].
  Eigen::Vector3d couple(const MeshedBeams<3>&, const State& state,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return couple_of(state, pairs_, y);
  }
  /// Both with R b_k in place of b_k, for any matrix R: see Turned.
  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state, const Eigen::Matrix3d& R,
                           const ConstraintTerms<3>::Multipliers* y) const {
    return terms_of(state, turned(R), y);
  }
  Eigen::Vector3d couple(const MeshedBeams<3>&, const State& state, const Eigen::Matrix3d& R,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return couple_of(state, turned(R), y);
  }

 private:
  using Pairs = std::array<AxisPair, N>;

  Pairs turned(const Eigen::Matrix3d& R) const {
    Pairs pairs = pairs_;
    for (auto& [a, b] : pairs) b = R * b;
    return pairs;
  }
  ConstraintTerms<3> terms_of(const State& state, const Pairs& pairs,
                              const ConstraintTerms<3>::Multipliers* y) const {
    ConstraintTerms<3> terms(rows, y != nullptr);
    const int first = static_cast<int>(ends_[0].dofs().size()),
              second = static_cast<int>(ends_[1].dofs().size());
    for (int k = 0; k < rows; ++k) {
      const auto& [a, b] = pairs[k];
      const Eigen::Vector3d u = ends_[0].turned(state, a), v = ends_[1].turned(state, b);
      const Eigen::Matrix<double, 3, 4> by_first = ends_[0].gradient(state, a),
                                        by_second = ends_[1].gradient(state, b);
      terms.value[k] = u.dot(v);
      terms.gradient.row(k).head(first) = (v.transpose() * by_first).head(first);
      terms.gradient.row(k).segment(first, second) = (u.transpose() * by_second).head(second);
      if (!y) continue;
      const double weight = (*y)[k];
      const Eigen::Matrix4d both = weight * by_first.transpose() * by_second;
      terms.hessian.topLeftCorner(first, first) +=
          weight * ends_[0].hessian(state, a, v).topLeftCorner(first, first);
      terms.hessian.block(first, first, second, second) +=
          weight * ends_[1].hessian(state, b, u).topLeftCorner(second, second);
      terms.hessian.block(0, first, first, second) += both.topLeftCorner(first, second);
      terms.hessian.block(first, 0, second, first) += both.topLeftCorner(first, second).transpose();
    }
    return terms;
  }
  Eigen::Vector3d couple_of(const State& state, const Pairs& pairs,
                            const Eigen::Ref<const Eigen::VectorXd>& y) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 0; k < rows; ++k)
      sum += y[k] * ends_[1].turned(state, pairs[k][1]).cross(ends_[0].turned(state, pairs[k][0]));
    return sum;
  }

  std::array<TurningAxes, 2> ends_;
  Pairs pairs_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
