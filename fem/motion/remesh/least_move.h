#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// Coordinates in which nodes may move, and the parabola of the potential energy there: g'd + d'Kd/2.
struct EnergyParabola {
  Eigen::MatrixXd K, M;  ///< stiffness and mass, symmetric, M positive definite
  Eigen::VectorXd g;
};

/// A move d = -(K + mu M)^-1 g.
struct LeastMove {
  Eigen::VectorXd d;
  double mu;
};

/// The least move in the mass norm, min d'Md/2, that takes an excess e of energy away, g'd + d'Kd/2 = -e.
/// Where the parabola has no such place, the move to its lowest one (for e < 0 to its highest).
LeastMove least_move(const EnergyParabola& energy, double e);
/// The least move where mu of a neighbouring parabola and excess is known.
LeastMove least_move(const EnergyParabola& energy, double e, double near);

}  // namespace nurbeam
