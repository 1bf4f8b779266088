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

/// What happens on the way; what is empty is not told.
struct SimulationObserver {
  std::function<void(Snapshot)> snapshot = nullptr;  ///< at every output time
  SnapshotContents contents = {};                    ///< of these; those of motions always have energies
  /// Takes the elements of a snapshot, which then has none, before it: at this time.
  std::function<void(double time, int beam, std::vector<ElementRecord>& elements)> elements = nullptr;
  std::function<void(const StepRecord&)> progress = nullptr;  ///< after every step
  std::function<bool()> interrupted =
      nullptr;  ///< true asks to end: a motion after its step, a search for rest at once
  /// Every change of the mesh, with the beams before and after it.
  std::function<void(const RunEvent&, const std::vector<BeamRecord>&, const std::vector<BeamRecord>&)>
      mesh_changed = nullptr;
  std::function<bool()> checkpoint_due = nullptr;  ///< asked after every step
  /// Takes checkpoints (`inputs` left empty): those asked for, and the last one.
  std::function<void(Checkpoint)> checkpoint = nullptr;
  RunFollower* follower = nullptr;  ///< of a run that has not been interrupted
};

}  // namespace nurbeam
