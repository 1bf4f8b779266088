#include "fem/constraints/held_roll.h"

namespace nurbeam {

ConstraintTerms<3> ForkedRoll::terms(const MeshedBeams<3>&, const State& state,
                                     const ConstraintTerms<3>::Multipliers* y) const {
  ConstraintTerms<3> terms(rows, y != nullptr);
  const Eigen::Vector4d x = node_.coordinates(state.q);
  terms.value[0] = node_.triad<double>(x).d2.dot(node_.drawn.col(0));
  terms.gradient.leftCols<4>() = gradient<double>(x).transpose();
  if (!y) return terms;
  using T = Dual<4>;
  Eigen::Matrix<T, 4, 1> variables;
  for (int i = 0; i < 4; ++i) variables[i] = T::variable(x[i], i);
  const Eigen::Matrix<T, 4, 1> g = gradient<T>(variables);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) terms.hessian(i, j) = (*y)[0] * g[i].d[j];
  return terms;
}

Eigen::Vector3d ForkedRoll::couple(const MeshedBeams<3>&, const State& state,
                                   const Eigen::Ref<const Eigen::VectorXd>& y) const {
  return -y[0] * node_.triad<double>(node_.coordinates(state.q)).d2.cross(node_.drawn.col(0));
}

}  // namespace nurbeam
