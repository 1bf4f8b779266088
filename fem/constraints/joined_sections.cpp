#include "fem/constraints/joined_sections.h"

namespace nurbeam {

ConstraintTerms<3> JoinedSections::terms(const MeshedBeams<3>&, const State& state,
                                         const ConstraintTerms<3>::Multipliers* y) const {
  ConstraintTerms<3> terms(rows, y != nullptr);
  Vector8<double> x;
  x << a_.coordinates(state.q), b_.coordinates(state.q);
  const Triads<double> both = triads<double>(x);
  for (int i = 0; i < 3; ++i) terms.value += both.a.col(i).cross(both.b.col(i)) / 2;
  for (int k = 0; k < 3; ++k)
    terms.gradient.block<1, 8>(k, 0) = gradient<double>(x, Eigen::Vector3d::Unit(k)).transpose();
  if (!y) return terms;
  using T = Dual<8>;
  Vector8<T> variables;
  for (int i = 0; i < 8; ++i) variables[i] = T::variable(x[i], i);
  const Vector8<T> g = gradient<T>(variables, *y);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) terms.hessian(i, j) = g[i].d[j];
  return terms;
}

Eigen::Vector3d JoinedSections::couple(const MeshedBeams<3>&, const State& state,
                                       const Eigen::Ref<const Eigen::VectorXd>& y) const {
  Vector8<double> x;
  x << a_.coordinates(state.q), b_.coordinates(state.q);
  return -moments<double>(triads<double>(x), Eigen::Vector3d(y)).a;
}

}  // namespace nurbeam
