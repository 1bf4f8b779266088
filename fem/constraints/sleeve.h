#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/directions_across.h"
#include "fem/mesh/mesh_elements.h"
#include "fem/mesh/widened.h"

namespace nurbeam {

/// A sleeve holds the direction of the beam at the node of a rider, which runs through it: n . r_s = 0 for
/// the D - 1 directions n across it; bending passes. It turns from the drawn direction to its own as
/// State::load grows to 1.
template <int D>
class HeldSlope {
 public:
  /// The rider is carried as a node with one slope, and has a direction.
  HeldSlope(const MeshedBeams<D>& at, int rider) {
    const Rider& led = at.structure.riders[rider];
    own_ = led.direction->normalized();
    drawn_ = at.structure.beam_of(led).curve.tangent(led.s).normalized();
    const int slope = at.mesh.nodes[led.beam][at.mesh.riders[rider].node].slope_left;
    for (int d = 0; d < D; ++d) dofs_.push_back(slope + d);
  }

  static constexpr ConstraintOffers offers{.linear = true, .couple = true};
  static constexpr int rows = D - 1;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>&, const State& state,
                           const typename ConstraintTerms<D>::Multipliers*) const {
    ConstraintTerms<D> terms(rows, false);
    const Eigen::Matrix<double, D - 1, D> n = across(state.load);
    terms.value = n * state.q.segment<D>(dofs_[0]);
    terms.gradient.template leftCols<D>() = n;
    return terms;
  }
  /// The couple of the sleeve on the beam for its multipliers [N m].
  Eigen::Vector3d couple(const MeshedBeams<D>&, const State& state,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const {
    const Eigen::Matrix<double, D, 1> on_slope = -across(state.load).transpose() * y,
                                      rs = state.q.segment<D>(dofs_[0]);
    return widened<D>(rs).cross(widened<D>(on_slope));
  }

 private:
  Eigen::Matrix<double, D - 1, D> across(double load) const {
    return directions_across<D>(((1 - load) * drawn_ + load * own_).normalized());
  }

  Eigen::Vector3d drawn_, own_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
