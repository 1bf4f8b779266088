#pragma once
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/held_axis.h"
#include "fem/constraints/joined_sections.h"
#include "fem/constraints/joined_slopes.h"
#include "fem/mesh/point_on_beam.h"
#include "fem/structure/beam_joint.h"

namespace nurbeam {

/// Two material points keep their drawn offset r_a(s_a) - r_b(s_b): D rows; coordinates of both elements.
template <int D>
class JoinedPoints {
 public:
  JoinedPoints(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, const BeamJoint& joint)
      : points_(at, drawn, joint.beam_a, joint.s_a, joint.beam_b, joint.s_b) {
    const auto& beams = at.structure.beams;
    const Eigen::Vector3d distance =
        beams[joint.beam_a].curve.position(joint.s_a) - beams[joint.beam_b].curve.position(joint.s_b);
    distance_ = distance.head<D>();
  }

  static constexpr ConstraintOffers offers{.constant = true};
  static constexpr int rows = D;
  const std::vector<int>& dofs() const { return points_.dofs; }
  bool is_constant() const { return points_.a.is_fixed() && points_.b.is_fixed(); }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    constexpr int n = element_size<D>;
    ConstraintTerms<D> terms(rows, y != nullptr);
    const PointShape<D> at_a = points_.a.shape(at, state.q), at_b = points_.b.shape(at, state.q);
    const PointField<D> a = at_a.position(), b = at_b.position();
    terms.value = a.value - b.value - distance_;
    terms.gradient.template leftCols<n>() = a.gradient;
    terms.gradient.template rightCols<n>() = -b.gradient;
    if (!y) return terms;
    auto hessian_b = terms.hessian.template bottomRightCorner<n, n>();
    a.add_hessian(*y, 1, at_a.nodes, terms.hessian);
    b.add_hessian(*y, -1, at_b.nodes, hessian_b);
    return terms;
  }

 private:
  PointPair<D> points_;
  Eigen::Matrix<double, D, 1> distance_;
};

template <int D, class Add>
void bind(const BeamJoint& joint, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  add(JoinedPoints<D>(at, drawn, joint));
  const auto& beams = at.structure.beams;
  if constexpr (D == 3)
    if (beams[joint.beam_a].has_torsion() && beams[joint.beam_b].has_torsion()) {
      const auto a = [&] { return NodeSection::at(at, drawn, joint.beam_a, joint.s_a); };
      const auto b = [&] { return NodeSection::at(at, drawn, joint.beam_b, joint.s_b); };
      if (joint.rigid) return add(JoinedSections(a(), b()));
      if (joint.axis) return add(HeldAxis(b(), a(), *joint.axis));
    }
  if (!joint.rigid) return;
  add(JoinedSlopes<D>(PointPair<D>(at, drawn, joint.beam_a, joint.s_a, joint.beam_b, joint.s_b),
                      HeldAngle<D>::drawn(beams[joint.beam_a].curve.tangent(joint.s_a),
                                          beams[joint.beam_b].curve.tangent(joint.s_b))));
}

}  // namespace nurbeam
