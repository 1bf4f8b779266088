#include "solver/system/force_sizes.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/system/tangent_matrix.h"

namespace nurbeam {

State resting(const SecondOrderSystem& system, State state) {
  state.v.setZero(system.coordinate_count());
  state.a.setZero(system.coordinate_count());
  if (state.lambda.size() != system.constraint_count()) state.lambda.setZero(system.constraint_count());
  return state;
}

ForceSizes::Applied ForceSizes::applied(const State& state) const {
  State free = resting(system_, state);
  const Eigen::VectorXd with_multipliers = dynamics(free);
  free.lambda.setZero();
  const double held = work(with_multipliers - dynamics(free));
  free.load = 0;
  const Eigen::VectorXd unloaded = dynamics(free);
  free.load = 1;
  const double load = work(dynamics(free) - unloaded);
  if (load > 0) return {true, std::max(load, held)};
  return {false, held > 0 && held > round_off(free) ? held : 0};
}

double ForceSizes::largest_force(const State& state) const {
  const Applied found = applied(state);
  if (found.by_load) return found.largest;
  State free = resting(system_, state);
  free.lambda.setZero();
  free.load = 0;
  const double internal = work(dynamics(free));
  free.load = 1;
  const double moved = work(dynamics(towards_constraints(free)));
  // Beside a moved support the applied force is round-off.
  const double largest = std::max(found.largest, moved > 10 * internal ? moved : 0);
  if (largest > 0) return largest;
  return internal > 0 ? internal : 1;
}

// Round-off of forces that cancel in stiff parts.
double ForceSizes::round_off(const State& state) const {
  constexpr double part = 8 * std::numeric_limits<double>::epsilon();
  const Eigen::SparseMatrix<double> stiffness = tangent_matrix(system_, state, {.stiffness = 1});
  const Eigen::Index n = scale_.size();
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(n);
  for (Eigen::Index column = 0; column < n; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(stiffness, column); entry; ++entry)
      if (entry.row() < n)
        forces[entry.row()] += std::abs(entry.value()) * (std::abs(state.q[column]) + scale_[column]);
  return part * work(forces);
}

// The state with held coordinates moved by G'g towards their constraints: a move of the size that the
// constraints ask for.
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
