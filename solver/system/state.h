#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// t, q, v, a, lambda: a value; a trajectory is a sequence of them.
struct State {
  double t = 0;
  Eigen::VectorXd q;            ///< generalised positions
  Eigen::VectorXd v;            ///< dq/dt
  Eigen::VectorXd a;            ///< d2q/dt2
  Eigen::VectorXd lambda;       ///< Lagrange multipliers
  double load = 1;              ///< factor on the loads: below 1 on the way to an equilibrium
  Eigen::VectorXd memory = {};  ///< of forces that have one, as of the last step; empty: these do not act
  Eigen::VectorXd sides = {};   ///< 1 or 0: of 0 on which laws with a kink there are held; empty: theirs
};

}  // namespace nurbeam
