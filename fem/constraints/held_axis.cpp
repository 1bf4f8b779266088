#include "fem/constraints/held_axis.h"

namespace nurbeam {

ConstraintTerms<3> HeldAxis::terms(const MeshedBeams<3>&, const State& state,
                                   const ConstraintTerms<3>::Multipliers* y) const {
  ConstraintTerms<3> terms(rows, y != nullptr);
  const Vector8<double> x = coordinates(state.q);
  const int n = static_cast<int>(dofs_.size());
  for (int k = 0; k < rows; ++k) {
    terms.value[k] = axis<double>(x).dot(across<double>(x, Eigen::Vector2d::Unit(k)));
    terms.gradient.row(k).head(n) = gradient<double>(x, Eigen::Vector2d::Unit(k)).head(n).transpose();
  }
  if (!y) return terms;
  const Vector8<Dual<8>> g = gradient<Dual<8>>(twist::variables<8, double>(x), y->head<2>());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) terms.hessian(i, j) = g[i].d[j];
  return terms;
}

Eigen::Vector3d HeldAxis::couple(const MeshedBeams<3>&, const State& state,
                                 const Eigen::Ref<const Eigen::VectorXd>& y) const {
  const Vector8<double> x = coordinates(state.q);
  const Eigen::Vector3d on_section = axis<double>(x).cross(across<double>(x, y));
  return other_ ? Eigen::Vector3d(-on_section) : on_section;
}

}  // namespace nurbeam
