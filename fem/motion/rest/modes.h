#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "fem/motion/remesh/mesh_rules.h"
#include "fem/motion/remesh/meshed_state.h"
#include "fem/motion/rest/resting_place.h"

namespace nurbeam {

/// What is asked of the neighbourhood of a state at rest.
struct ModesOptions {
  enum class Kind {
    vibration,  ///< (K - omega^2 M) x = 0
    buckling    ///< (K + factor K_g) x = 0, K_g by the loads: neither weight nor what is permanent
  };
  Kind kind = Kind::vibration;
  int count = 10;
  bool about_equilibrium =
      true;                 ///< under all loads, for buckling under what is no load; else as drawn, without
  bool bodies_held = true;  ///< where they are drawn; else they slide, about the place where they rest
  LengthControl length_control = {};
};

struct Mode {
  double omega = 0;       ///< of a vibration [rad/s]; 0 where it is a rigid motion
  double round_off = 0;   ///< of omega^2 [1/s^2]
  double factor = 0;      ///< on the loads, where the model buckles; below 0 for reversed loads
  Eigen::VectorXd shape;  ///< of the coordinates; of a vibration with x'M x = 1 kg m^2 or kg
  /// x'M e of a vibration, e the unit translation along each axis [sqrt(kg)]; its square is the effective
  /// mass.
  Eigen::Vector3d participation = Eigen::Vector3d::Zero();
};

struct ModesReport {
  RestReport rest;          ///< how the state was found; its failure is also that of what followed
  MeshedState at;           ///< the state
  double mass = 0;          ///< of the whole model [kg]
  std::vector<Mode> modes;  ///< increasing; fewer than asked for where the model has not so many
};

/// Small vibrations about a state at rest, or the factors on loads under which it buckles. Constraints hold
/// exactly, in first order: shapes lie in the null space of their gradients. K is the tangent of the state,
/// with the geometric stiffness of its section forces, supports and loads.
///
/// In the model's own coordinates. Fails where the state is unstable, the tangent is not symmetric (loads
/// that follow a section, moments in space) or the eigenvalues are not found. `interrupted` is asked all
/// along: true ends the search, and its report says so.
ModesReport find_modes(std::shared_ptr<const BeamModel> model, const ModesOptions& options,
                       const std::function<bool()>& interrupted);

}  // namespace nurbeam
