#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "fem/motion/record/loaded_between.h"
#include "fem/motion/record/loose_part.h"
#include "fem/motion/record/run_event.h"
#include "solver/rest/static_equilibrium.h"
#include "solver/steps/integrator.h"

namespace nurbeam {

enum class SimulationStatus { done, not_converged, interrupted };

/// Where a sliding body is at a moment.
struct BodyPlace {
  int rider;
  double s, rate;  ///< [m] (on a ring in [0, length)), [m/s]
};

/// Why a simulation cannot go on.
struct Failure {
  enum class Kind {
    initial_velocities,  ///< cannot be made consistent with the constraints
    mass_matrix,         ///< is singular
    step,                ///< and shorter ones fail: `step`
    impact,              ///< of the rider's body at the end of its beam is singular
    projection,          ///< of velocities on a new mesh is singular
    mesh,                ///< length control finds none
    mesh_energy,         ///< a change of the mesh for the rider's body would change the energy by `energy`
    energy,              ///< has come from nowhere, `energy`, more than all that moves
    endless_events,      ///< of the rider's body at one moment
    bodies_meet,         ///< those of two riders on one beam: they come `nearest` or nearer
    equilibrium,         ///< is not found: `equilibrium`
    resting_place,       ///< of a sliding body is not found
    leaves_beam,         ///< the rider's body, at a free end of its beam, where nothing holds it
    free_lengths,        ///< of connectors are not found
    wrong_sign,          ///< of `force` in the `connector` whose length the equilibrium gives
    unstable_state,      ///< vibrations about it would grow with the rate `growth`
    no_energy,           ///< behind the tangent, which is not symmetric
    not_held,            ///< the tangent is singular
    nothing_buckles,     ///< by the loads
    eigenvalues          ///< are not found
  };
  Kind kind;
  double time = 0;  ///< [s]
  std::vector<BodyPlace> places = {};
  int rider = -1, other = -1;
  double distance = 0, nearest = 0;  ///< between the bodies of these, and at which a run can go on [m]
  StepStatus step = StepStatus::converged;
  StaticReport equilibrium = {};
  double energy = 0;  ///< [J]
  /// Steps of an explicit method must be no longer, and were; 0 where that is not the reason [s].
  double stable_step = 0;
  double growth = 0;  ///< [1/s]
  int connector = -1;
  double force = 0;  ///< [N]
  std::optional<LoosePart> loose =
      {};  ///< what moves furthest in the motion that nothing holds, where one is found
};

/// The least and the greatest of an energy in the frames so far [J].
struct EnergyRange {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  void add(double energy) {
    least = std::min(least, energy);
    greatest = std::max(greatest, energy);
  }
  double width() const { return std::max(0.0, greatest - least); }
};

/// How a simulation ended, and what it took.
struct SimulationReport {
  SimulationStatus status = SimulationStatus::done;
  std::optional<Failure> failure;  ///< where status is not_converged
  double time = 0;                 ///< reached [s]
  long steps = 0, rejected_steps = 0, newton_iterations = 0;
  /// Steps of a fixed length that were shortened, or a body would have slid too far over an element beside
  /// it; and the shortest of them [s].
  long cut_steps = 0;
  double shortest_cut = std::numeric_limits<double>::infinity();
  bool diverges = false;           ///< an equilibrium that was found leaves itself when it is touched
  std::optional<Loading> snap;     ///< under which the model snaps through or buckles, at rest
  std::optional<LoosePart> loose;  ///< of a mechanism, at the last rest
  double motion_seconds = 0, length_control_seconds = 0;
  double energy_drift = 0;         ///< largest departure of the total energy from its start [J]
  double integration_error = 0;    ///< the same without what events changed [J]
  double peak_kinetic_energy = 0;  ///< [J]
  EnergyRange strain_energy, gravity_energy;
  double energy_noise = 0;  ///< as energy_noise() has it [J]
  std::vector<RunEvent> events;

  /// What an error of the energy is to be compared with: the largest of the kinetic energy and of the changes
  /// of strain and gravity energy [J].
  double energy_scale() const {
    return std::max({peak_kinetic_energy, strain_energy.width(), gravity_energy.width()});
  }
  /// What round-off may make of the total energy [J].
  double energy_round_off() const {
    const auto size = [](const EnergyRange& range) {
      return range.width() > 0 || std::isfinite(range.least)
                 ? std::max(std::abs(range.least), std::abs(range.greatest))
                 : 0;
    };
    return energy_noise + 1e-11 * (peak_kinetic_energy + size(strain_energy) + size(gravity_energy));
  }

  void fail(Failure why) {
    status = SimulationStatus::not_converged;
    failure = std::move(why);
  }
};

}  // namespace nurbeam
