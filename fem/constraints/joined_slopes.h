#pragma once
#include <Eigen/Geometry>

#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/held_angle.h"
#include "fem/mesh/point_on_beam.h"

namespace nurbeam {

/// A material point on each of two elements.
template <int D>
struct PointPair {
  PointOnBeam<D> a, b;
  std::vector<int> dofs;  ///< coordinates of the element of a, then of the element of b

  PointPair(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, int beam_a, double s_a, int beam_b,
            double s_b)
      : a(at, drawn, beam_a, s_a), b(at, drawn, beam_b, s_b), dofs(a.dofs(at)) {
    const std::vector<int> others = b.dofs(at);
    dofs.insert(dofs.end(), others.begin(), others.end());
  }
};

/// The slopes at two material points keep their angle: 1 row; coordinates of both elements.
template <int D>
class JoinedSlopes {
 public:
  JoinedSlopes(PointPair<D> points, HeldAngle<D> angle) : points_(std::move(points)), angle_(angle) {}

  static constexpr ConstraintOffers offers{.couple = true};
  static constexpr int rows = 1;
  const std::vector<int>& dofs() const { return points_.dofs; }

  /// The couple on the first beam for its multiplier [N m].
  Eigen::Vector3d couple(const MeshedBeams<D>& at, const State& state,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const {
    const Eigen::Matrix<double, D, 1> a = points_.a.shape(at, state.q).slope().value,
                                      b = points_.b.shape(at, state.q).slope().value;
    const Eigen::Matrix<double, D, 1> on_slope = -y[0] * angle_.terms(a, b).gradient.template head<D>();
    return widened<D>(a).cross(widened<D>(on_slope));
  }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    constexpr int n = element_size<D>;
    ConstraintTerms<D> terms(rows, y != nullptr);
    const PointShape<D> at_a = points_.a.shape(at, state.q), at_b = points_.b.shape(at, state.q);
    const PointField<D> a = at_a.slope(), b = at_b.slope();
    const typename HeldAngle<D>::Terms held = angle_.terms(a.value, b.value);
    Eigen::Matrix<double, 2 * D, 2 * n> slopes = Eigen::Matrix<double, 2 * D, 2 * n>::Zero();
    slopes.template topLeftCorner<D, n>() = a.gradient;
    slopes.template bottomRightCorner<D, n>() = b.gradient;
    terms.value[0] = held.value;
    terms.gradient = held.gradient.transpose() * slopes;
    if (!y) return terms;
    const double y0 = (*y)[0];
    auto hessian_b = terms.hessian.template bottomRightCorner<n, n>();
    terms.hessian = y0 * slopes.transpose() * held.hessian * slopes;
    a.add_hessian(held.gradient.template head<D>(), y0, at_a.nodes, terms.hessian);
    b.add_hessian(held.gradient.template tail<D>(), y0, at_b.nodes, hessian_b);
    return terms;
  }

 private:
  PointPair<D> points_;
  HeldAngle<D> angle_;
};

}  // namespace nurbeam
