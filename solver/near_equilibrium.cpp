#include "solver/near_equilibrium.h"

#include <limits>

#include "solver/equilibrated_kkt.h"

namespace nurbeam {

bool settle_near(const SecondOrderSystem& system, State& state) {
  using Vector = Eigen::VectorXd;
  // What a correction leaves is of its square.
  constexpr double close = 1e-6, last = 1e-8;
  constexpr int most_corrections = 6;
  const Eigen::Index n = system.coordinate_count(), m = system.constraint_count();
  const Vector scale = system.coordinate_scale();
  Eigen::SparseMatrix<double> tangent = system.tangent_pattern().matrix();
  Vector dynamics(n), constraints(m), rows(n + m);
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_corrections; ++i) {
    if (!system.admissible(state)) return false;
    system.residual(state, dynamics, constraints);
    system.tangent(state, {.stiffness = 1}, tangent);
    const EquilibratedKkt kkt(tangent, static_cast<int>(n));
    if (!kkt.regular()) return false;
    rows << dynamics, constraints;
    const Vector correction = kkt.solve(rows);
    const double size = correction.head(n).cwiseQuotient(scale).lpNorm<Eigen::Infinity>();
    if (!(size < before / 2)) return before < close;
    state.q -= correction.head(n);
    state.lambda -= correction.tail(m);
    if (size < last) return true;
    before = size;
  }
  return before < close;
}

}  // namespace nurbeam
