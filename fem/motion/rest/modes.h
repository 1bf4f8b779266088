#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "fem/motion/remesh/mesh_rules.h"
#include "fem/motion/remesh/meshed_state.h"
#include "fem/motion/rest/resting_place.h"

namespace nurbeam {

/// Options of a modal or buckling analysis about a state at rest.
struct ModesOptions {
  enum class Kind {
    /// (K - omega^2 M) x = 0; in a frame that turns, or with rotors, (K + i omega G - omega^2 M) x = 0
    vibration,
    buckling  ///< (K + factor K_g) x = 0, where K_g comes from the loads, without weight and permanent forces
  };
  Kind kind = Kind::vibration;
  int count = 10;
  bool about_equilibrium =
      true;  ///< under all loads, for buckling under all permanent forces; false: as drawn, without loads
  bool bodies_held = true;  ///< held where they are drawn; false: they slide, about the place where they rest
  LengthControl length_control = {};
};

struct Mode {
  double omega = 0;       ///< circular frequency of a vibration [rad/s]; 0 for a rigid motion
  double round_off = 0;   ///< round-off of omega^2 [1/s^2]
  double factor = 0;      ///< load factor at which the model buckles; below 0 for reversed loads
  Eigen::VectorXd shape;  ///< of the coordinates; for a vibration scaled to x'M x = 1 kg m^2 or kg
  /// x'M e of a vibration [sqrt(kg)], e the unit translation along each axis; its square is the effective
  /// mass.
  Eigen::Vector3d participation = Eigen::Vector3d::Zero();
  /// Whether bodies with a rotor, or the nodes of a frame that turns, go round as these turn (1) or against
  /// it (-1); 0 where they do neither, or nothing turns.
  int whirl = 0;
};

struct ModesReport {
  RestReport rest;  ///< report of the search for the state; its failure is also that of the later analysis
  MeshedState at;   ///< the state
  double mass = 0;  ///< mass of the whole model [kg]
  std::vector<Mode> modes;  ///< increasing; fewer than asked for where the model has no more
};

/// Small vibrations about a state at rest, or the load factors under which it buckles. Constraints hold
/// exactly, in first order: shapes lie in the null space of their gradients. K is the tangent of the state,
/// with the geometric stiffness of its section forces, supports and loads.
///
/// Results are in the model's own coordinates. Fails where the state is unstable, the tangent is not
/// symmetric (loads that follow a section, moments in space) or the eigenvalues are not found. `interrupted`
/// is asked all along: true ends the search, and its report says so.
ModesReport find_modes(std::shared_ptr<const BeamModel> model, const ModesOptions& options,
                       const std::function<bool()>& interrupted);

}  // namespace nurbeam
