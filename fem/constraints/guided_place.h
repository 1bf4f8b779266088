#pragma once
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/directions_across.h"
#include "fem/mesh/point_on_beam.h"
#include "fem/structure/support.h"

namespace nurbeam {

/// A place of a beam that moves along a line alone: n . (r(s) - r_0(s) - d(t)) = 0 for the D - 1 directions n
/// across the line.
template <int D>
class GuidedPlace {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// `support` must outlive the constraint.
  GuidedPlace(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, const Support& support)
      : point_(at, drawn, support.beam, support.s),
        dofs_(point_.dofs(at)),
        across_(directions_across<D>(support.guide->normalized())),
        drawn_(at.structure.beams[support.beam].curve.position(support.s).template head<D>()),
        motion_(support.motion ? &*support.motion : nullptr) {}

  static constexpr ConstraintOffers offers{.linear = true, .rates = true, .force = true, .work = true};
  static constexpr int rows = D - 1;
  const std::vector<int>& dofs() const { return dofs_; }
  /// The force on the beam for its multipliers [N].
  Eigen::Vector3d force(const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return widened<D>(Vector(-across_.transpose() * y));
  }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state,
                           const typename ConstraintTerms<D>::Multipliers*) const {
    ConstraintTerms<D> terms(rows, false);
    const PointField<D> r = point_.shape(at, state.q).position();
    Vector moved = r.value - drawn_;
    if (motion_) moved -= state.load * motion_->at(state.t).value.template head<D>();
    terms.value = across_ * moved;
    terms.gradient.template leftCols<element_size<D>>() = across_ * r.gradient;
    return terms;
  }

  /// Work between two states on one mesh [J]: the mean force over the displacement.
  double work(const State& from, const State& to, const Eigen::Ref<const Eigen::VectorXd>& y_from,
              const Eigen::Ref<const Eigen::VectorXd>& y_to) const {
    if (!motion_) return 0;
    const Eigen::Vector3d moved = motion_->at(to.t).value - motion_->at(from.t).value;
    return (force(y_from) + force(y_to)).dot(moved) / 2;
  }

  /// dg/dt and d2g/dt2 at fixed q [m/s], [m/s^2].
  Eigen::Matrix<double, D - 1, 1> rate(double t) const {
    if (!motion_) return Eigen::Matrix<double, D - 1, 1>::Zero();
    return -across_ * motion_->at(t).rate.template head<D>();
  }
  Eigen::Matrix<double, D - 1, 1> acceleration(double t) const {
    if (!motion_) return Eigen::Matrix<double, D - 1, 1>::Zero();
    return -across_ * motion_->at(t).acceleration.template head<D>();
  }

 private:
  PointOnBeam<D> point_;
  std::vector<int> dofs_;
  Eigen::Matrix<double, D - 1, D> across_;
  Vector drawn_;  // [m]
  const DisplacementTable* motion_;
};

}  // namespace nurbeam
