#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// The place of a rider, held or prescribed, s = s(t): 1 row.
template <int D>
class HeldPlace {
 public:
  HeldPlace(int dof, double s) : dofs_{dof}, s_(s) {}
  /// `motion` must outlive the constraint.
  HeldPlace(int dof, const PlaceMotion& motion) : dofs_{dof}, motion_(&motion) {}

  static constexpr ConstraintOffers offers{.linear = true, .rates = true, .work = true, .place = true};
  static constexpr int rows = 1;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>&, const State& state,
                           const typename ConstraintTerms<D>::Multipliers*) const {
    ConstraintTerms<D> terms(rows, false);
    terms.value[0] = state.q[dofs_[0]] - (motion_ ? motion_->at(state.t).s : s_);
    terms.gradient(0, 0) = 1;
    return terms;
  }
  /// The coordinate of the place.
  int place() const { return dofs_[0]; }
  /// Work between two states on one mesh [J]: the mean force over the displacement.
  double work(const State& from, const State& to, const Eigen::Ref<const Eigen::VectorXd>& y_from,
              const Eigen::Ref<const Eigen::VectorXd>& y_to) const {
    return -(y_from[0] + y_to[0]) / 2 * (to.q[place()] - from.q[place()]);
  }
  /// dg/dt [m/s] and d2g/dt2 [m/s^2] at fixed q.
  Eigen::Matrix<double, 1, 1> rate(double t) const {
    return Eigen::Matrix<double, 1, 1>(motion_ ? -motion_->at(t).speed : 0.0);
  }
  Eigen::Matrix<double, 1, 1> acceleration(double t) const {
    return Eigen::Matrix<double, 1, 1>(motion_ ? -motion_->at(t).acceleration : 0.0);
  }

 private:
  std::vector<int> dofs_;
  double s_ = 0;
  const PlaceMotion* motion_ = nullptr;
};

}  // namespace nurbeam
