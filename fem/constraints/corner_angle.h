#pragma once
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/held_angle.h"
#include "fem/constraints/joined_sections.h"
#include "fem/constraints/passed_roll.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// The two slopes of a node at a rigid corner keep the drawn angle: 1 row; coordinates of both slopes.
template <int D>
class CornerAngle {
 public:
  CornerAngle(const ReferenceCurve& curve, const MeshNode& node)
      : angle_(HeldAngle<D>::drawn(curve.tangent(node.s, true), curve.tangent(node.s))) {
    for (const int slope : {node.slope_left, node.slope_right})
      for (int d = 0; d < D; ++d) dofs_.push_back(slope + d);
  }

  /// Binds the constraints of the rigid corners of all beams: the angle, or with torsion the relative
  /// orientation of both sections. Binds those of kinks with torsion, which goes over them.
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    for (std::size_t b = 0; b < binding.at.mesh.nodes.size(); ++b) bind_corners(binding.at, b, add);
  }

  static constexpr ConstraintOffers offers{};
  static constexpr int rows = 1;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>&, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    ConstraintTerms<D> terms(rows, y != nullptr);
    const typename HeldAngle<D>::Terms held =
        angle_.terms(state.q.segment<D>(dofs_[0]), state.q.segment<D>(dofs_[D]));
    terms.value[0] = held.value;
    terms.gradient.template leftCols<2 * D>() = held.gradient.transpose();
    if (y) terms.hessian.template topLeftCorner<2 * D, 2 * D>() = (*y)[0] * held.hessian;
    return terms;
  }

 private:
  template <class Add>
  static void bind_corners(const MeshedBeams<D>& at, std::size_t b, Add&& add) {
    const Beam& beam = at.structure.beams[b];
    const int first = at.mesh.first_span[b], spans = at.mesh.first_span[b + 1] - first;
    for (int i = 0; i < static_cast<int>(at.mesh.nodes[b].size()); ++i) {
      const MeshNode& node = at.mesh.nodes[b][i];
      const NodeKind kind = node.home < 0 ? NodeKind::smooth : beam.home[node.home].kind;
      if constexpr (D == 3)
        if (kind == NodeKind::kink && beam.has_torsion()) add(PassedRoll(at, static_cast<int>(b), i));
      if (kind != NodeKind::rigid) continue;
      if constexpr (D == 3)
        if (beam.has_torsion()) {
          add(JoinedSections(NodeSection(at.elements[first + (i + spans - 1) % spans], 1),
                             NodeSection(at.elements[first + i], 0)));
          continue;
        }
      add(CornerAngle(beam.curve, node));
    }
  }

  HeldAngle<D> angle_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
