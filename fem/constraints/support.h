#pragma once
#include "fem/constraints/clamp.h"
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/guided_place.h"
#include "fem/constraints/held_axis.h"
#include "fem/constraints/held_roll.h"
#include "fem/constraints/turned.h"
#include "fem/mesh/point_on_beam.h"
#include "fem/structure/support.h"

namespace nurbeam {

/// A place of a beam held where it is drawn, or moved from there: r(s) = r_0(s) + d(t), D rows. A turn takes
/// the drawn place r_0 about its axis.
template <int D>
class HeldPosition {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// `motion` and `turn`, if any, must outlive the constraint.
  HeldPosition(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, int beam, double s,
               const DisplacementTable* motion = nullptr, const AxisTurn* turn = nullptr)
      : point_(at, drawn, beam, s),
        dofs_(point_.dofs(at)),
        drawn_(at.structure.beams[beam].curve.position(s).template head<D>()),
        arm_(turn ? Vector(drawn_ - turn->about.head<D>()) : Vector::Zero()),
        motion_(motion),
        turn_(turn) {}

  static constexpr ConstraintOffers offers{.rates = true, .constant = true, .work = true, .drive = true};
  static constexpr int rows = D;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    ConstraintTerms<D> terms(rows, y != nullptr);
    const PointShape<D> shape = point_.shape(at, state.q);
    const PointField<D> r = shape.position();
    terms.value = r.value - drawn_;
    if (turn_) terms.value -= turned(turn_->at(state.t, state.load).R) - arm_;
    if (motion_) terms.value -= state.load * motion_->at(state.t).value.template head<D>();
    terms.gradient.template leftCols<element_size<D>>() = r.gradient;
    if (y) r.add_hessian(*y, 1, shape.nodes, terms.hessian);
    return terms;
  }

  bool is_constant() const { return point_.is_fixed(); }

  /// Work between two states on one mesh [J]: the mean force over the displacement, and the mean moment over
  /// the angle.
  double work(const MeshedBeams<D>& at, const State& from, const State& to,
              const Eigen::Ref<const Eigen::VectorXd>& y_from,
              const Eigen::Ref<const Eigen::VectorXd>& y_to) const {
    double sum = turn_ ? (drive(at, from, y_from) + drive(at, to, y_to)) / 2 * (angle(to) - angle(from)) : 0;
    if (!motion_) return sum;
    const Eigen::Vector3d moved = motion_->at(to.t).value - motion_->at(from.t).value;
    return sum - (y_from + y_to).dot(moved.template head<D>()) / 2;
  }
  /// The moment about the axis that takes the place round [N m].
  double drive(const MeshedBeams<D>&, const State& state, const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return turn_ ? -y.dot(turned(turn_->by(angle(state)).first)) : 0;
  }

  /// dg/dt [m/s] and d2g/dt2 [m/s^2] at fixed q.
  Vector rate(double t) const {
    Vector rate = motion_ ? Vector(-motion_->at(t).rate.template head<D>()) : Vector::Zero();
    if (turn_) rate -= turned(turn_->at(t, 1).first);
    return rate;
  }
  Vector acceleration(double t) const {
    Vector rate = motion_ ? Vector(-motion_->at(t).acceleration.template head<D>()) : Vector::Zero();
    if (turn_) rate -= turned(turn_->at(t, 1).second);
    return rate;
  }

 private:
  Vector turned(const Eigen::Matrix3d& R) const { return R.topLeftCorner<D, D>() * arm_; }
  double angle(const State& state) const { return state.load * turn_->angle.at(state.t).angle; }

  PointOnBeam<D> point_;
  std::vector<int> dofs_;
  Vector drawn_, arm_;  // the drawn place, and from the axis of the turn [m]
  const DisplacementTable* motion_;
  const AxisTurn* turn_;
};

template <int D, class Add>
void bind_place(const Support& support, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  if (support.guide && support.turn) return add(TurnedGuide<D>(at, drawn, support));
  if (support.guide) return add(GuidedPlace<D>(at, drawn, support));
  add(HeldPosition<D>(at, drawn, support.beam, support.s, support.motion ? &*support.motion : nullptr,
                      support.turn ? &*support.turn : nullptr));
}

/// Direction and section of a support that turns.
template <int D, class Add>
void bind_turned(const Support& support, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  if constexpr (D == 3)
    if (at.structure.beams[support.beam].has_torsion()) {
      const NodeSection node = NodeSection::at(at, drawn, support.beam, support.s);
      if (support.clamped) add(Turned<3, ClampedSection>(ClampedSection(node), *support.turn));
      if (support.fork) add(Turned<3, TurnedFork>(TurnedFork(node), *support.turn));
      if (support.axis) add(Turned<3, TurnedHinge>(TurnedHinge(node, *support.axis), *support.turn));
      return;
    }
  if (support.clamped)
    add(Turned<D, ClampedDirection<D>>(ClampedDirection<D>(at, drawn, support), *support.turn));
}

template <int D, class Add>
void bind(const Support& support, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  bind_place<D>(support, at, drawn, add);
  if (support.turn) return bind_turned<D>(support, at, drawn, add);
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
