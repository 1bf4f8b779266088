#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// Velocities of all bodies (3 each) [m/s], and per rider the spin of a body that rolls with a section
/// [rad/s].
struct BodyMotions {
  std::vector<Eigen::Vector3d> velocities;
  std::vector<double> spins;
};
BodyMotions body_motions(const BeamSystem& system, const State& state);

/// The momentum that a motion of one mesh has in the coordinates of another mesh of the same model:
///
///   p = int (rho A N'v + rho I_p W'w) ds over all elements, plus the bodies' momenta,
///   N = dv/d(dq/dt) and W = dw/d(dq/dt) at fixed material.
///
/// Here v is the material velocity and w the spin of sections in the motion. Elements are integrated in
/// parts, between all nodes of both meshes and breaks of the drawing. For elements with fixed ends that both
/// meshes have, the momentum of the axis is taken over unchanged.
class CarriedMomentum {
 public:
  /// The motion `state` of `from`; `to` must outlive it.
  CarriedMomentum(const BeamSystem& from, const State& state, const BeamSystem& to);

  /// (n) Momentum in the coordinates of a state of the other mesh.
  Eigen::VectorXd on(const State& state) const;

 private:
  template <class Of>
  struct Point {
    double s, length;  // [m]; length: weight in the integral
    Of motion;
  };
  // Points of an element of the other mesh, by its index.
  template <class Of>
  struct Element {
    std::size_t index;
    std::vector<Point<Of>> points = {};
  };
  template <int D>
  void carry(const BeamSystem& from, const State& state);

  const BeamSystem* to_;
  BodyMotions bodies_;
  Eigen::VectorXd kept_;                        // (n) the part that does not depend on the state
  std::vector<Element<Eigen::Vector3d>> axes_;  // elements whose part does: velocities
  std::vector<Element<double>> sections_;       // and spins
};

}  // namespace nurbeam
