#pragma once
#include <string>
#include <utility>
#include <vector>

#include "fem/motion/run_event.h"

namespace nurbeam {

enum class SimulationStatus { done, not_converged, interrupted };

/// How a simulation ended, and what it took.
struct SimulationReport {
  SimulationStatus status = SimulationStatus::done;
  std::string message;  ///< why it ended before its end: time, joint, place
  double time = 0;      ///< reached [s]
  long steps = 0, rejected_steps = 0, newton_iterations = 0;
  double motion_seconds = 0, length_control_seconds = 0;
  double energy_drift = 0;         ///< largest departure of the total energy from its start [J]
  double integration_error = 0;    ///< the same without what events changed [J]
  double peak_kinetic_energy = 0;  ///< [J]
  std::vector<RunEvent> events;

  void fail(SimulationStatus why, std::string what) {
    status = why;
    message = std::move(what);
  }
};

}  // namespace nurbeam
