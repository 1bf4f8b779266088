#include "fem/constraints/passed_roll.h"

namespace nurbeam {

ConstraintTerms<3> PassedRoll::terms(const MeshedBeams<3>&, const State& state,
                                     const ConstraintTerms<3>::Multipliers* y) const {
  ConstraintTerms<3> terms(rows, y != nullptr);
  Vector8<double> x;
  x << a_.coordinates(state.q), b_.coordinates(state.q);
  terms.value[0] = SectionTurn<double>(a_.triad<double>(x.head<4>()), b_.triad<double>(x.tail<4>()), 0).S;
  terms.gradient.leftCols<8>() = gradient<double>(x).transpose();
  if (!y) return terms;
  using T = Dual<8>;
  const Vector8<T> g = gradient<T>(twist::variables<8, double>(x));
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) terms.hessian(i, j) = (*y)[0] * g[i].d[j];
  return terms;
}

}  // namespace nurbeam
