#pragma once
#include <string>

#include "fem/constraints/clamp.h"
#include "fem/constraints/constraint_terms.h"
#include "fem/constraints/held_roll.h"
#include "fem/mesh/point_on_beam.h"

namespace nurbeam {

/// Holds a place of a beam where it is drawn.
struct Support {
  int beam;
  double s;              ///< [m]
  bool clamped = false;  ///< position and direction of the slope; its magnitude stays free
  bool fork = false;     ///< position and roll of the section, of a beam with torsion
  std::string name = {};
};

/// r(s) = r_0(s): D rows.
template <int D>
class HeldPosition {
 public:
  HeldPosition(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, int beam, double s)
      : point_(at, drawn, beam, s), dofs_(point_.dofs(at)) {}

  static constexpr int rows = D;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    ConstraintTerms<D> terms(rows, y != nullptr);
    const PointShape<D> shape = point_.shape(at, state.q);
    const PointField<D> r = shape.position();
    const ReferenceCurve& curve = point_.element(at).element.curve();
    terms.value = r.value - curve.position(point_.s()).template head<D>();
    terms.gradient.template leftCols<element_size<D>>() = r.gradient;
    if (y) r.add_hessian(*y, 1, shape.nodes, terms.hessian);
    return terms;
  }

 private:
  PointOnBeam<D> point_;
  std::vector<int> dofs_;
};

template <int D, class Add>
void bind(const Support& support, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  add(HeldPosition<D>(at, drawn, support.beam, support.s));
  if (support.clamped) add(HeldDirection<D>(at, drawn, support.beam, support.s));
  if constexpr (D == 3) {
    if (!at.structure.beams[support.beam].has_torsion()) return;
    if (support.clamped) add(ClampedRoll(NodeSection::at(at, drawn, support.beam, support.s)));
    if (support.fork) add(ForkedRoll(NodeSection::at(at, drawn, support.beam, support.s)));
  }
}

}  // namespace nurbeam
