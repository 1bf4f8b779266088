#pragma once
#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/binding.h"
#include "fem/mesh/connector_axis.h"

namespace nurbeam {

/// A rod, |d| = l_0 or n . d = l_0: 1 row. The multiplier is its pull N.
template <int D>
class KeptLength {
 public:
  KeptLength(int connector, const MeshedBeams<D>& at)
      : number_(connector),
        connector_(&at.structure.connectors[connector]),
        axis_(*connector_, at.structure, at.mesh) {}

  /// Binds all rods.
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const std::vector<Connector>& connectors = binding.at.structure.connectors;
    for (int i = 0; i < static_cast<int>(connectors.size()); ++i)
      if (connectors[i].type == ConnectorType::rod) add(KeptLength(i, binding.at));
  }

  static constexpr ConstraintOffers offers{.on_body = true, .connector = true};
  static constexpr int rows = 1;
  const std::vector<int>& dofs() const { return axis_.dofs(); }
  /// Number of the rod among the connectors of the model.
  int connector() const { return number_; }
  /// Length |d| or n . d [m], and N [N].
  std::pair<double, double> length_and_force(const State& state,
                                             const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return {axis_.line(state).length, y[0]};
  }
  /// The force on a body [N].
  Eigen::Matrix<double, D, 1> on_body(int body, const State& state,
                                      const Eigen::Ref<const Eigen::VectorXd>& y) const {
    const Eigen::Matrix<double, D, 1> pull = y[0] * axis_.line(state).n;
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
  int number_;
  const Connector* connector_;
  ConnectorAxis<D> axis_;
};

}  // namespace nurbeam
