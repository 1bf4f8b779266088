#pragma once
#include "fem/constraints/constraint_terms.h"
#include "fem/mesh/connector_axis.h"

namespace nurbeam {

/// A rod, a connector that keeps its length, |d| = l_0 or n . d = l_0: 1 row, whose multiplier is its pull N.
template <int D>
class KeptLength {
 public:
  /// `connector` must outlive it.
  KeptLength(const Connector& connector, const MeshedBeams<D>& at)
      : connector_(&connector), axis_(connector, at.structure, at.mesh) {}

  static constexpr int rows = 1;
  const std::vector<int>& dofs() const { return axis_.dofs(); }
  const Connector& connector() const { return *connector_; }
  /// |d| or n . d [m].
  double length(const State& state) const { return axis_.line(state).length; }
  /// What it gives to a body when it pulls with N [N].
  Eigen::Matrix<double, D, 1> on_body(int body, double N, const State& state) const {
    const Eigen::Matrix<double, D, 1> pull = N * axis_.line(state).n;
    Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero();
    if (axis_.body(0) == body) sum += pull;
    if (axis_.body(1) == body) sum -= pull;
    return sum;
  }

  ConstraintTerms<D> terms(const MeshedBeams<D>&, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    ConstraintTerms<D> terms(rows, y != nullptr);
    const auto line = axis_.line(state);
    terms.value[0] = line.length - connector_->length;
    terms.gradient.template block<1, D>(0, 0) = -line.n.transpose();
    terms.gradient.template block<1, D>(0, D) = line.n.transpose();
    if (y) terms.hessian.template topLeftCorner<2 * D, 2 * D>() = axis_.in_ends((*y)[0] * line.curvature);
    return terms;
  }

 private:
  const Connector* connector_;
  ConnectorAxis<D> axis_;
};

}  // namespace nurbeam
