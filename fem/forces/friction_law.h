#pragma once
#include <Eigen/Core>

#include "fem/structure/friction.h"

namespace nurbeam {

/// Memory of a body's friction from the end of the last step.
struct FrictionMemory {
  double z = 0;  ///< elastic displacement of the stick, along the beam [m]
  double s = 0;  ///< place of the body [m]
  /// Direction of sliding: 1 towards the beam's end, -1 towards its start; 0: the body sticks.
  int slides = 0;
};

/// State of a body on a beam as its friction sees it.
struct FrictionPoint {
  Eigen::Vector3d force;        ///< force of the beam on the body [N]
  Eigen::Vector3d left, right;  ///< r_s on both sides, equal where there is no kink [-]
  double s, rate, t;            ///< [m], [m/s], [s]
};

/// The constants of one body's friction.
struct FrictionOfBody {
  const Friction* friction;
  double stiffness, damping;  ///< stiffness k [N/m] and damping d [N s/m] of the stick
  double least_force;         ///< e, the force below which F_n and R are rounded off [N]
  double start = 0;           ///< place from which its travel counts [m]
};

/// The generalised force Q on the place of a body, with its derivatives by all of a FrictionPoint but t.
///
/// Let l = (|left| + |right|)/2, m the bisector of the tangents, theta the angle between them, and
/// F_n = |force - m m.force|. Then Q = l F.
/// While the body sticks, F = -k z* - (d + c) l rate with z* = z + l (s - s_n); it sticks as long as
/// |k z* + d l rate| <= B. While it slides, F = -+B - c l rate. A quadratic resistance adds -c_2 (l rate)|l
/// rate| to both. The bound is B = phi N + F_c. By Coulomb's law N = F_n and phi = mu / cos(theta/2). By the
/// capstan's law N is the whole force R = T2 t2 - T1 t1, and T2/T1 = exp(mu theta) gives phi = tau /
/// sqrt(sin^2(theta/2) + tau^2 cos^2(theta/2)) with tau = tanh(mu theta/2), for every angle. A bearing has N
/// = R and phi = mu. For N stands sqrt(N^2 + e^2) - e, where e is the least force.
struct FrictionForce {
  double along;           ///< F, the jump of the beam's tension, positive towards its end [N]
  double value;           ///< Q [N]
  double per_along;       ///< l = Q / F [-]
  double bound;           ///< B [N]
  double trial;           ///< k z* + d l rate [N]
  FrictionMemory memory;  ///< memory after a step that ends in this state
  Eigen::Vector3d by_force = Eigen::Vector3d::Zero(), by_left = by_force, by_right = by_force;
  double by_s = 0, by_rate = 0;
};
FrictionForce friction_force(const FrictionOfBody& body, const FrictionPoint& at,
                             const FrictionMemory& before);

}  // namespace nurbeam
