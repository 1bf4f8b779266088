#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "fem/motion/run_event.h"
#include "solver/integrator.h"
#include "solver/static_equilibrium.h"

namespace nurbeam {

enum class SimulationStatus { done, not_converged, interrupted };

/// Where a sliding body is at a moment.
struct BodyPlace {
  int joint;
  double s, rate;  ///< [m] (on a ring in [0, length)), [m/s]
};

/// Why a simulation cannot go on.
struct Failure {
  enum class Kind {
    initial_velocities,  ///< cannot be made consistent with the constraints
    mass_matrix,         ///< is singular
    step,                ///< and shorter ones fail: `step`
    impact,              ///< of the joint's body at the end of its beam is singular
    projection,          ///< of velocities on a new mesh is singular
    mesh,                ///< length control finds none
    bodies_meet,         ///< sliding bodies on one beam
    equilibrium,         ///< is not found: `equilibrium`
    resting_place        ///< of a sliding body is not found
  };
  Kind kind;
  double time = 0;  ///< [s]
  std::vector<BodyPlace> places = {};
  int joint = -1;
  StepStatus step = StepStatus::converged;
  StaticReport equilibrium = {};
};

/// How a simulation ended, and what it took.
struct SimulationReport {
  SimulationStatus status = SimulationStatus::done;
  std::optional<Failure> failure;  ///< where status is not_converged
  double time = 0;                 ///< reached [s]
  long steps = 0, rejected_steps = 0, newton_iterations = 0;
  double motion_seconds = 0, length_control_seconds = 0;
  double energy_drift = 0;         ///< largest departure of the total energy from its start [J]
  double integration_error = 0;    ///< the same without what events changed [J]
  double peak_kinetic_energy = 0;  ///< [J]
  std::vector<RunEvent> events;

  void fail(Failure why) {
    status = SimulationStatus::not_converged;
    failure = std::move(why);
  }
};

}  // namespace nurbeam
