#pragma once
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/node_section.h"

namespace nurbeam {

/// The section goes over a kink, of a node or at a sliding body, by parallel transport. The section behind
/// the kink is not turned about the tangent against the one before it: d2_a . d1_b - d1_a . d2_b = 0
/// (SectionTurn::S). 1 row; coordinates (r_s, angle) of both sides. Torsion so passes the body, and bending
/// does not.
class PassedRoll {
 public:
  PassedRoll(const MeshedBeams<3>& at, int rider)
      : PassedRoll(at, at.structure.riders[rider].beam, at.mesh.riders[rider].node) {}
  /// `node`: its index among those of the beam.
  PassedRoll(const MeshedBeams<3>& at, int beam, int node) : PassedRoll(sides(at, beam, node)) {}

  static constexpr ConstraintOffers offers{};
  static constexpr int rows = 1;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state,
                           const ConstraintTerms<3>::Multipliers* y) const;

 private:
  template <class T>
  using Vector8 = Eigen::Matrix<T, 8, 1>;
  using Sides = std::pair<NodeSection, NodeSection>;

  explicit PassedRoll(const Sides& sides) : a_(sides.first), b_(sides.second) {
    for (const NodeSection* node : {&a_, &b_})
      dofs_.insert(dofs_.end(), node->dofs.begin(), node->dofs.end());
  }
  static Sides sides(const MeshedBeams<3>& at, int beam, int node) {
    const int first = at.mesh.first_span[beam], spans = at.mesh.first_span[beam + 1] - first;
    return {NodeSection(at.elements[first + (node + spans - 1) % spans], 1),
            NodeSection(at.elements[first + node], 0)};
  }
  // Gradient of S: the spins change S by m . (dphi_a - dphi_b), m = d2_a x d1_b - d1_a x d2_b.
  template <class T>
  Vector8<T> gradient(const Vector8<T>& x) const {
    const SectionTriad<T> a = a_.triad<T>(x.template head<4>()), b = b_.triad<T>(x.template tail<4>());
    const Vector3<T> m = a.d2.cross(b.d1) - a.d1.cross(b.d2), less = -m;
    Vector8<T> g;
    g << a_.force<T>(x.template head<4>(), m), b_.force<T>(x.template tail<4>(), less);
    return g;
  }

  NodeSection a_, b_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
