#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/drawn_coordinates.h"
#include "fem/mesh/mesh_elements.h"
#include "fem/structure/held_body.h"
#include "fem/structure/turn.h"

namespace nurbeam {

/// A body held at a point or moved from there, r_body = r_drawn + load (position + d(t) - r_drawn): D rows. A
/// turn takes the position about its axis. The force on the body is minus its multipliers; for an eyelet it
/// is the force on the beam that runs through it.
template <int D>
class HeldPositionOfBody {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// `motion` and `turn` must outlive the constraint.
  HeldPositionOfBody(const MeshedBeams<D>& at, int body, const Eigen::Vector3d& position,
                     const std::optional<DisplacementTable>& motion, const std::optional<AxisTurn>& turn = {})
      : body_(body),
        drawn_(drawn_place(at.structure, Grip::on_body(body)).template head<D>()),
        away_(position.template head<D>() - drawn_),
        arm_(turn ? Vector((position - turn->about).template head<D>()) : Vector::Zero()),
        motion_(motion ? &*motion : nullptr),
        turn_(turn ? &*turn : nullptr) {
    const int r = at.mesh.bodies[body];
    for (int d = 0; d < D; ++d) dofs_.push_back(r + d);
  }

  static constexpr ConstraintOffers offers{
      .linear = true, .rates = true, .on_body = true, .work = true, .drive = true};
  static constexpr int rows = D;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>&, const State& state,
                           const typename ConstraintTerms<D>::Multipliers*) const {
    ConstraintTerms<D> terms(rows, false);
    terms.value = state.q.segment<D>(dofs_[0]) - drawn_ - state.load * away_;
    if (turn_) terms.value -= turned(turn_->at(state.t, state.load).R) - arm_;
    if (motion_) terms.value -= state.load * motion_->at(state.t).value.template head<D>();
    terms.gradient.template leftCols<D>().diagonal().setOnes();
    return terms;
  }
  /// Work between two states on one mesh [J]: the mean force over the displacement, and the mean moment over
  /// the angle.
  double work(const MeshedBeams<D>& at, const State& from, const State& to,
              const Eigen::Ref<const Eigen::VectorXd>& y_from,
              const Eigen::Ref<const Eigen::VectorXd>& y_to) const {
    const double sum =
        turn_ ? (drive(at, from, y_from) + drive(at, to, y_to)) / 2 * (angle(to) - angle(from)) : 0;
    if (!motion_) return sum;
    const Eigen::Vector3d moved = motion_->at(to.t).value - motion_->at(from.t).value;
    return sum - (y_from + y_to).dot(moved.template head<D>()) / 2;
  }
  /// The moment about the axis that takes the position round [N m].
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
  /// The force on a body [N].
  Vector on_body(int body, const State&, const typename ConstraintTerms<D>::Multipliers& y) const {
    return body == body_ ? Vector(-y) : Vector(Vector::Zero());
  }

 private:
  Vector turned(const Eigen::Matrix3d& R) const { return R.topLeftCorner<D, D>() * arm_; }
  double angle(const State& state) const { return state.load * turn_->angle.at(state.t).angle; }

  int body_;
  Vector drawn_, away_, arm_;  // arm: from the axis of the turn to the position [m]
  const DisplacementTable* motion_;
  const AxisTurn* turn_;
  std::vector<int> dofs_;
};

template <int D, class Add>
void bind(const HeldBody& held, const MeshedBeams<D>& at, const Eigen::VectorXd&, Add&& add) {
  add(HeldPositionOfBody<D>(at, held.body, held.position, held.motion));
}

}  // namespace nurbeam
