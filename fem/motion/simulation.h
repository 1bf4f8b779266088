#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/motion/checkpoint.h"
#include "fem/motion/integrators.h"
#include "fem/motion/length_control.h"
#include "fem/motion/record_frame.h"
#include "fem/motion/simulation_report.h"

namespace nurbeam {

/// How a simulation is to be run; times in seconds.
struct SimulationOptions {
  bool statics = false;
  bool start_from_equilibrium = false;
  double end_time = 0;
  std::optional<double> step;        ///< fixed steps (of length control with IDA); else error control
  std::vector<double> output_times;  ///< increasing, within [0, end_time]
  IntegratorSettings integrator;
  LengthControl length_control;
};

/// What happens on the way.
struct SimulationObserver {
  std::function<void(const Frame&)> frame;          ///< at every output time, in the model's own coordinates
  std::function<void(const StepRecord&)> progress;  ///< after every step
  std::function<bool()> interrupted;                ///< true asks to end after the current step
  /// If set: every change of the mesh, with the beams before and after it.
  std::function<void(const RunEvent&, const std::vector<BeamRecord>&, const std::vector<BeamRecord>&)>
      mesh_changed = nullptr;
  /// If set: asked after every step whether a restart point is wanted.
  std::function<bool()> restart_point_due = nullptr;
  /// If set: takes restart points (`inputs` left empty): those asked for, and the last one.
  std::function<void(const RestartPoint&)> restart_point = nullptr;
};

/// Runs a model from its drawn shape, or from equilibrium, to its end: integration, length control, bodies
/// that leave or stop at a beam's end. A static analysis ends with one frame at time 0; sliding bodies come
/// to rest. With `from`, which must belong to the same model and options, a motion goes on from there: with
/// generalized-alpha and the explicit methods bit by bit as if it had never been interrupted; IDA starts
/// afresh with a short step.
SimulationReport simulate(const BeamModel& model, const std::vector<ProbePlace>& probes,
                          const SimulationOptions& options, const SimulationObserver& observer,
                          const RestartPoint* from = nullptr);

}  // namespace nurbeam
