#include "solver/system/balance_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbeam {

void measure_balance(const SecondOrderSystem& system, const State& at, const double* kkt,
                     const StepScale& scale, const Eigen::VectorXd& inverse_scale, State& still,
                     Eigen::VectorXd& reference) {
  constexpr double round_off = 32 * std::numeric_limits<double>::epsilon();
  const Eigen::Index n = at.q.size();
  const Eigen::Index m = at.lambda.size();
  const double floor = round_off / scale.tolerance;
  still.a.setZero();
  still.lambda.setZero();
  reference.resize(n + m);
  // The vector of the reference serves as room, for one kind of force after the other.
  const auto largest_work = [&] {
    return reference.head(n).cwiseAbs().cwiseQuotient(inverse_scale).lpNorm<Eigen::Infinity>();
  };
  system.residual(still, reference.head(n), reference.tail(m));
  still.a = at.a;
  still.lambda = at.lambda;
  const double of_forces = largest_work();
  double* entries = reference.data();
  const SparsePattern& pattern = system.tangent_pattern();
  const int *rows = pattern.rows().data(), *starts = pattern.column_starts().data();
  reference.setZero();
  for (Eigen::Index column = n; column < n + m; ++column)
    for (int k = starts[column]; k < starts[column + 1]; ++k)
      if (rows[k] < n) entries[rows[k]] += kkt[k] * at.lambda[column - n];
  const double work = std::max(of_forces, largest_work());
  reference.setConstant(std::numeric_limits<double>::min());
  for (Eigen::Index column = 0; column < n; ++column) {
    const double rounding = floor * (std::abs(at.q[column]) + 1 / inverse_scale[column]);
    const double moved = rounding + scale.h2 * std::abs(at.a[column]);
    for (int k = starts[column]; k < starts[column + 1]; ++k)
      entries[rows[k]] += (rows[k] < n ? rounding : moved) * std::abs(kkt[k]);
  }
  for (Eigen::Index column = n; column < n + m; ++column) {
    const double rounding = floor * std::abs(at.lambda[column - n]) * scale.h2 / scale.mass_scale;
    for (int k = starts[column]; k < starts[column + 1]; ++k) entries[rows[k]] += rounding * std::abs(kkt[k]);
  }
  reference.head(n) += scale.h2 / scale.mass_scale * work * inverse_scale;
  reference = reference.cwiseInverse();
}

}  // namespace nurbeam
