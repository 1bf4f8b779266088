#pragma once
#include "fem/constraints/clamp.h"
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/guided_place.h"
#include "fem/constraints/held_axis.h"
#include "fem/constraints/held_roll.h"
#include "fem/mesh/point_on_beam.h"
#include "fem/structure/support.h"

namespace nurbeam {

/// A place of a beam held where it is drawn, or moved from there: r(s) = r_0(s) + d(t), D rows.
template <int D>
class HeldPosition {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// `motion`, if any, must outlive the constraint.
  HeldPosition(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, int beam, double s,
               const DisplacementTable* motion = nullptr)
      : point_(at, drawn, beam, s),
        dofs_(point_.dofs(at)),
        drawn_(at.structure.beams[beam].curve.position(s).template head<D>()),
        motion_(motion) {}

  static constexpr ConstraintOffers offers{.rates = true, .constant = true, .work = true};
  static constexpr int rows = D;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    ConstraintTerms<D> terms(rows, y != nullptr);
    const PointShape<D> shape = point_.shape(at, state.q);
    const PointField<D> r = shape.position();
    terms.value = r.value - drawn_;
    if (motion_) terms.value -= state.load * motion_->at(state.t).value.template head<D>();
    terms.gradient.template leftCols<element_size<D>>() = r.gradient;
    if (y) r.add_hessian(*y, 1, shape.nodes, terms.hessian);
    return terms;
  }

  bool is_constant() const { return point_.is_fixed(); }

  /// Work between two states on one mesh [J]: the mean force over the displacement.
  double work(const State& from, const State& to, const Eigen::Ref<const Eigen::VectorXd>& y_from,
              const Eigen::Ref<const Eigen::VectorXd>& y_to) const {
    if (!motion_) return 0;
    const Eigen::Vector3d moved = motion_->at(to.t).value - motion_->at(from.t).value;
    return -(y_from + y_to).dot(moved.template head<D>()) / 2;
  }

  /// dg/dt [m/s] and d2g/dt2 [m/s^2] at fixed q.
  Vector rate(double t) const {
    return motion_ ? Vector(-motion_->at(t).rate.template head<D>()) : Vector::Zero();
  }
  Vector acceleration(double t) const {
    return motion_ ? Vector(-motion_->at(t).acceleration.template head<D>()) : Vector::Zero();
  }

 private:
  PointOnBeam<D> point_;
  std::vector<int> dofs_;
  Vector drawn_;  // [m]
  const DisplacementTable* motion_;
};

template <int D, class Add>
void bind(const Support& support, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  if (support.guide) return add(GuidedPlace<D>(at, drawn, support));
  add(HeldPosition<D>(at, drawn, support.beam, support.s, support.motion ? &*support.motion : nullptr));
  if (support.holds_slope()) add(HeldDirection<D>(at, drawn, support.beam, support.s));
  if constexpr (D == 3) {
    if (!at.structure.beams[support.beam].has_torsion()) return;
    if (support.holds_slope()) add(ClampedRoll(NodeSection::at(at, drawn, support.beam, support.s)));
    if (support.fork || (support.clamped && support.sharp))
      add(ForkedRoll(NodeSection::at(at, drawn, support.beam, support.s)));
    if (support.axis) add(HeldAxis(NodeSection::at(at, drawn, support.beam, support.s), *support.axis));
  }
}

}  // namespace nurbeam
