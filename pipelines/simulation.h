#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fem/length_control.h"
#include "pipelines/record_frame.h"
#include "pipelines/run_summary.h"
#include "solver/explicit_integrator.h"
#include "solver/generalized_alpha.h"
#include "solver/ida_integrator.h"
#include "solver/static_equilibrium.h"

namespace nurbeam {

/// How a simulation is to be run; times in seconds.
struct SimulationOptions {
  bool statics = false;
  bool start_from_equilibrium = false;
  double end_time = 0;
  std::optional<double> step;        ///< fixed steps (of length control with IDA); else error control
  std::vector<double> output_times;  ///< increasing, within [0, end_time]
  std::variant<GeneralizedAlpha, Ida, ExplicitRungeKutta> integrator;
  LengthControl length_control;
};

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
};

/// What happens on the way.
struct SimulationObserver {
  std::function<void(const Frame&)> frame;  ///< at every output time, in the model's own coordinates
  std::function<void(double)> progress;     ///< simulated time after every step
  std::function<bool()> interrupted;        ///< true asks to end after the current step
  /// If set: every change of the mesh, with the beams before and after it.
  std::function<void(const RunEvent&, const std::vector<BeamRecord>&, const std::vector<BeamRecord>&)>
      mesh_changed = nullptr;
};

/// Runs a model from its drawn shape, or from equilibrium, to its end: integration, length control, bodies
/// that leave or stop at a beam's end. A static analysis ends with one frame at time 0; sliding bodies come
/// to rest.
SimulationReport simulate(const BeamModel& model, const std::vector<ProbePlace>& probes,
                          const SimulationOptions& options, const SimulationObserver& observer);

}  // namespace nurbeam
