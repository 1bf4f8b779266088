#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/checkpoint.h"
#include "fem/motion/integrators.h"
#include "fem/motion/mesh_rules.h"
#include "fem/motion/run_follower.h"
#include "fem/motion/simulation_report.h"
#include "fem/motion/snapshot.h"
#include "fem/system/beam_system.h"

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
  std::function<void(const Snapshot&)> snapshot = nullptr;    ///< at every output time
  std::function<void(const StepRecord&)> progress = nullptr;  ///< after every step
  std::function<bool()> interrupted =
      nullptr;  ///< true asks to end: a motion after its step, a search for rest at once
  /// Every change of the mesh, with the beams before and after it.
  std::function<void(const RunEvent&, const std::vector<BeamRecord>&, const std::vector<BeamRecord>&)>
      mesh_changed = nullptr;
  std::function<bool()> checkpoint_due = nullptr;  ///< asked after every step
  /// Takes checkpoints (`inputs` left empty): those asked for, and the last one.
  std::function<void(const Checkpoint&)> checkpoint = nullptr;
  RunFollower* follower = nullptr;  ///< of a run that has not been interrupted
};

/// A run that is taken step by step: from the drawn shape of a model, or from equilibrium, to its end. All is
/// in the model's own coordinates.
class Simulation {
 public:
  /// With `from`, which must belong to the same model and options, a motion goes on from there.
  Simulation(std::shared_ptr<const BeamModel> model, std::vector<ProbePlace> probes,
             SimulationOptions options, SimulationObserver observer = {}, const Checkpoint* from = nullptr);
  Simulation(Simulation&&) noexcept;
  ~Simulation();

  /// Takes what is next: the state at time 0; then a step, at most to the next output time, with what follows
  /// from it, or the next state at rest. Returns whether more is to come. What a force or the observer throws
  /// arrives unchanged; a motion can then go on from the last step, while a search for rest ends the run.
  bool advance();
  /// Changes forces, in place and in their number, between two steps. Returns whether the motion goes on.
  bool change_forces(const std::function<void(std::vector<Force>&)>& change);

  const BeamSystem& system() const;
  const State& state() const;
  SimulationReport report() const;
  /// The state with what is known of the steps since the last snapshot.
  Snapshot present() const;
  /// Of the present moment. Throws std::invalid_argument before the first call of advance(), and in statics.
  Checkpoint checkpoint() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Runs a model from its drawn shape, or from equilibrium, to its end: integration, length control, bodies
/// that leave or stop at a beam's end. A static analysis has a snapshot at rest under the loads of each
/// output time, followed from one to the next; where there is none, of time 0. Sliding bodies come to rest.
/// With `from`, which must belong to the same model and options, a motion goes on from there: with
/// generalized-alpha and the explicit methods bit by bit as if it had never been interrupted; IDA starts
/// afresh with a short step. All is in the model's own coordinates.
SimulationReport simulate(std::shared_ptr<const BeamModel> model, const std::vector<ProbePlace>& probes,
                          const SimulationOptions& options, const SimulationObserver& observer,
                          const Checkpoint* from = nullptr);
/// The same of a copy of the model.
SimulationReport simulate(const BeamModel& model, const std::vector<ProbePlace>& probes,
                          const SimulationOptions& options, const SimulationObserver& observer,
                          const Checkpoint* from = nullptr);

}  // namespace nurbeam
