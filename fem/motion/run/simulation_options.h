#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "fem/motion/record/checkpoint.h"
#include "fem/motion/record/simulation_report.h"
#include "fem/motion/record/snapshot.h"
#include "fem/motion/remesh/mesh_rules.h"
#include "fem/motion/run/integrators.h"
#include "fem/motion/run/run_follower.h"

namespace nurbeam {

/// A step of another run, or a part of one.
struct GivenStep {
  double end, length;  ///< [s]
};

/// Settings of a simulation; times in seconds.
struct SimulationOptions {
  bool statics = false;
  bool start_from_equilibrium = false;
  double end_time = 0;
  std::optional<double> step;        ///< fixed steps; empty: error control
  std::vector<double> output_times;  ///< increasing, within [0, end_time]
  IntegratorSettings integrator;
  LengthControl length_control;
  /// Without fixed steps: the step that is to be under way at a time, in place of the method's own control,
  /// whose tolerance is then 0. Its end lies after that time. Steps that fail are still divided.
  std::function<GivenStep(double time)> given_step = nullptr;
};

/// Observer of a run; functions that are empty are not called.
struct SimulationObserver {
  std::function<void(Snapshot)> snapshot = nullptr;  ///< at every output time
  /// For moments between output times where something is larger than before and after: snapshots without
  /// elements and probes. Called at the end, and between steps; not in order of time.
  std::function<void(Snapshot)> peak = nullptr;
  SnapshotContents contents = {};  ///< contents of snapshots; snapshots of motions always have energies
  /// Takes the elements of a snapshot, which then has none; called before it with its time.
  std::function<void(double time, int beam, std::vector<ElementRecord>& elements)> elements = nullptr;
  std::function<void(const StepRecord&)> progress = nullptr;  ///< after every step
  std::function<bool()> interrupted =
      nullptr;  ///< true asks to end: a motion after its step, a search for rest at once
  /// Called at every change of the mesh, with the beams before and after it.
  std::function<void(const RunEvent&, const std::vector<BeamRecord>&, const std::vector<BeamRecord>&)>
      mesh_changed = nullptr;
  std::function<bool()> checkpoint_due = nullptr;  ///< asked after every step
  /// Takes checkpoints (`inputs` left empty): those that are due, and the last one.
  std::function<void(Checkpoint)> checkpoint = nullptr;
  /// For a run that has not been interrupted. Its steps of generalized-alpha do not settle, as their
  /// derivatives do not know how.
  RunFollower* follower = nullptr;
};

}  // namespace nurbeam
