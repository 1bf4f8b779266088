#pragma once
#include <Eigen/Core>

#include "fem/structure/friction.h"

namespace nurbeam {

/// What a body's friction remembers of the last step.
struct FrictionMemory {
  double z = 0;    ///< elastic displacement of the stick, along the beam [m]
  double s = 0;    ///< place of the body [m]
  int slides = 0;  ///< the way that it slides: 1 towards the beam's end, -1 towards its start; 0: it sticks
};

/// A body on a beam at one moment, as its friction sees it.
struct FrictionPoint {
  Eigen::Vector3d force;        ///< of the beam on the body [N]
  Eigen::Vector3d left, right;  ///< r_s on both sides, one where there is no kink [-]
  double s, rate, t;            ///< [m], [m/s], [s]
};

/// The constants of one body's friction.
struct FrictionOfBody {
  const Friction* friction;
  double stiffness, damping;  ///< of the stick, k [N/m] and d [N s/m]
  double least_force;         ///< below which F_n is rounded off [N]
};

/// The generalised force Q on the place of a body and its derivatives by all of a FrictionPoint but t.
///
/// With l = (|left| + |right|)/2, m the bisector of the tangents, theta their angle, F_n = |force - m
/// m.force|: Q = l F, F = -k z* - (d + c) l rate where it sticks, z* = z + l (s - s_n), as long as |k z* + d
/// l rate| <= B, else F = -+B - c l rate. B = phi(mu, theta) F_n + F_c: phi = mu / cos(theta/2), or by the
/// capstan's law tanh(mu theta/2) / sin(theta/2). |F_n| is sqrt(F_n^2 + e^2) - e, e the least force.
struct FrictionForce {
  double along;           ///< F, the jump of the beam's tension, positive towards its end [N]
  double value;           ///< Q [N]
  double per_along;       ///< l = Q / F [-]
  double bound;           ///< B [N]
  double trial;           ///< k z* + d l rate [N]
  FrictionMemory memory;  ///< at the end of a step that comes to this moment
  Eigen::Vector3d by_force = Eigen::Vector3d::Zero(), by_left = by_force, by_right = by_force;
  double by_s = 0, by_rate = 0;
};
FrictionForce friction_force(const FrictionOfBody& body, const FrictionPoint& at,
                             const FrictionMemory& before);

}  // namespace nurbeam
