#include "solver/force_sizes.h"

#include <Eigen/SparseCore>
#include <algorithm>

#include "solver/tangent_matrix.h"

namespace nurbeam {

State resting(const SecondOrderSystem& system, State state) {
  state.v.setZero(system.coordinate_count());
  state.a.setZero(system.coordinate_count());
  if (state.lambda.size() != system.constraint_count()) state.lambda.setZero(system.constraint_count());
  return state;
}

double ForceSizes::applied_force(const State& state) const {
  State free = resting(system_, state);
  const Eigen::VectorXd with_multipliers = dynamics(free);
  free.lambda.setZero();
  const Eigen::VectorXd without_multipliers = dynamics(free);
  free.load = 0;
  const Eigen::VectorXd unloaded = dynamics(free);
  free.load = 1;
  const Eigen::VectorXd loaded = dynamics(free);
  return std::max(work(loaded - unloaded), work(with_multipliers - without_multipliers));
}

double ForceSizes::largest_force(const State& state) const {
  if (const double applied = applied_force(state); applied > 0) return applied;
  State free = resting(system_, state);
  free.lambda.setZero();
  free.load = 0;
  const double internal = work(dynamics(free));
  free.load = 1;
  const double held = work(dynamics(towards_constraints(free)));
  if (held > 10 * internal) return held;  // beside it the other is round-off
  return internal > 0 ? internal : 1;
}

// What is held moved by G'g to where it is to be: of the size of what the constraints ask for.
State ForceSizes::towards_constraints(State state) const {
  const int n = system_.coordinate_count(), m = system_.constraint_count();
  Eigen::VectorXd rows(n), constraints(m);
  system_.residual(state, rows, constraints);
  Eigen::SparseMatrix<double> kkt = tangent_matrix(system_, state, {});
  for (int row = 0; row < m; ++row)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(kkt, n + row); entry; ++entry)
      if (entry.row() < n) state.q[entry.row()] -= entry.value() * constraints[row];
  return state;
}

Eigen::VectorXd ForceSizes::dynamics(const State& state) const {
  Eigen::VectorXd rows(system_.coordinate_count()), constraints(system_.constraint_count());
  system_.residual(state, rows, constraints);
  return rows;
}

}  // namespace nurbeam
