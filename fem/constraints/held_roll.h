#pragma once
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/node_section.h"

namespace nurbeam {

/// The section of a clamped node keeps its drawn angle, theta = 0 in the chart of the drawing: 1 row. As the
/// clamp holds the direction of the slope too, the section keeps its drawn triad.
class ClampedRoll {
 public:
  explicit ClampedRoll(const NodeSection& node) : tangent_(node.drawn.col(2)), dofs_{node.dofs[3]} {}

  static constexpr ConstraintOffers offers{.linear = true, .couple = true};
  static constexpr int rows = 1;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state,
                           const ConstraintTerms<3>::Multipliers*) const {
    ConstraintTerms<3> terms(rows, false);
    terms.value[0] = state.q[dofs_[0]];
    terms.gradient(0, 0) = 1;
    return terms;
  }
  /// The couple on the beam for its multiplier [N m].
  Eigen::Vector3d couple(const MeshedBeams<3>&, const State&,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return -y[0] * tangent_;
  }

 private:
  Eigen::Vector3d tangent_;
  std::vector<int> dofs_;
};

/// A fork: the section does not roll and bends freely both ways, d2 . d1_0 = 0 with the drawn d1_0: 1 row.
class ForkedRoll {
 public:
  explicit ForkedRoll(const NodeSection& node) : node_(node), dofs_(node.dofs.begin(), node.dofs.end()) {}

  static constexpr ConstraintOffers offers{.couple = true};
  static constexpr int rows = 1;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state,
                           const ConstraintTerms<3>::Multipliers* y) const;
  /// The couple on the beam for its multiplier [N m].
  Eigen::Vector3d couple(const MeshedBeams<3>&, const State& state,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const;

 private:
  template <class T>
  Eigen::Matrix<T, 4, 1> gradient(const Eigen::Matrix<T, 4, 1>& x) const {
    const Vector3<T> d1_0 = node_.drawn.col(0).cast<T>();
    return node_.force<T>(x, node_.triad<T>(x).d2.cross(d1_0));
  }

  NodeSection node_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
