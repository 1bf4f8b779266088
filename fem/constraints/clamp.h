#pragma once
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/directions_across.h"
#include "fem/mesh/point_on_beam.h"

namespace nurbeam {

/// The slope keeps the drawn direction at a place of a beam, n . r_s(s) = 0 for the D - 1 directions n across
/// the drawing; its magnitude stays free.
template <int D>
class HeldDirection {
 public:
  HeldDirection(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, int beam, double s)
      : point_(at, drawn, beam, s),
        dofs_(point_.dofs(at)),
        across_(directions_across<D>(at.structure.beams[beam].curve.tangent(s))) {}

  static constexpr ConstraintOffers offers{.constant = true, .couple = true};
  static constexpr int rows = D - 1;
  const std::vector<int>& dofs() const { return dofs_; }
  bool is_constant() const { return point_.is_fixed(); }

  /// The couple of the clamp on the beam for its multipliers [N m].
  Eigen::Vector3d couple(const MeshedBeams<D>& at, const State& state,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const {
    const Eigen::Matrix<double, D, 1> on_slope = -across_.transpose() * y;
    const Eigen::Matrix<double, D, 1> rs = point_.shape(at, state.q).slope().value;
    return widened<D>(rs).cross(widened<D>(on_slope));
  }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    ConstraintTerms<D> terms(rows, y != nullptr);
    const PointShape<D> shape = point_.shape(at, state.q);
    const PointField<D> rs = shape.slope();
    terms.value = across_ * rs.value;
    terms.gradient.template leftCols<element_size<D>>() = across_ * rs.gradient;
    if (y) rs.add_hessian(across_.transpose() * y->template head<rows>(), 1, shape.nodes, terms.hessian);
    return terms;
  }

 private:
  PointOnBeam<D> point_;
  std::vector<int> dofs_;
  Eigen::Matrix<double, D - 1, D> across_;
};

}  // namespace nurbeam
