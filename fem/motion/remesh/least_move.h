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

/// The least in the mass norm, min d'Md/2, that takes an excess e of energy away, g'd + d'Kd/2 = -e, or to
/// the lowest (for e < 0 the highest) where the parabola has no such place.
LeastMove least_move(const EnergyParabola& energy, double e);
/// The same where mu is known of a neighbouring parabola and excess.
LeastMove least_move(const EnergyParabola& energy, double e, double near);

}  // namespace nurbeam
