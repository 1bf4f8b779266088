#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// The state t, q, v, a, lambda: a plain value; a trajectory is a sequence of states.
struct State {
  double t = 0;
  Eigen::VectorXd q;       ///< generalised positions
  Eigen::VectorXd v;       ///< dq/dt
  Eigen::VectorXd a;       ///< d2q/dt2
  Eigen::VectorXd lambda;  ///< Lagrange multipliers
  double load = 1;         ///< factor on the loads: below 1 on the way to an equilibrium
  /// Memory of forces after the last step; empty: forces with a memory do not act.
  Eigen::VectorXd memory = {};
  /// 1 or 0: the side of 0 on which each law with a kink is held; empty: by its strain.
  Eigen::VectorXd sides = {};
  /// Factor on energies that only keep a discretisation in shape: below 1 on the way to an equilibrium.
  double stabilisation = 1;
};

}  // namespace nurbeam
