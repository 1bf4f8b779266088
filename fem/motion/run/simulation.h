#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/run/simulation_options.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// A run that is taken step by step, from the drawn shape of a model or from equilibrium to its end. All is
/// in the model's own coordinates.
class Simulation {
 public:
  /// With `from`, which must belong to the same model and options, a motion goes on from that checkpoint.
  Simulation(std::shared_ptr<const BeamModel> model, std::vector<ProbePlace> probes,
             SimulationOptions options, SimulationObserver observer = {}, const Checkpoint* from = nullptr);
  Simulation(Simulation&&) noexcept;
  ~Simulation();

  /// Takes the next part of the run: the state at time 0; then a step with its consequences, at most to the
  /// next output time, or the next state at rest. Returns whether more is to come. Exceptions of a force or
  /// the observer arrive unchanged. A motion can then go on from the last step, while a search for rest ends
  /// the run.
  bool advance();
  /// Changes forces, in place and in their number, between two steps. Returns whether the motion goes on.
  bool change_forces(const std::function<void(std::vector<Force>&)>& change);

  const BeamSystem& system() const;
  const State& state() const;
  /// Moments since the last change of the mesh that may have extremes of the run: see
  /// SimulationObserver::peak, which gets those of the end.
  std::vector<Snapshot> peaks() const;
  SimulationReport report() const;
  /// A snapshot of the state, with the records of steps since the last snapshot.
  Snapshot present() const;
  /// The same of what is asked for alone.
  Snapshot present(const SnapshotContents& contents) const;
  /// A checkpoint of the present moment. Throws std::invalid_argument before the first call of advance(), and
  /// in statics.
  Checkpoint checkpoint() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Runs a model from its drawn shape, or from equilibrium, to its end: integration, length control, bodies
/// that leave or stop at a beam's end.
///
/// A static analysis has a snapshot at rest under the loads of each output time, followed from one to the
/// next; without output times, of time 0. Sliding bodies come to rest.
///
/// With `from`, which must belong to the same model and options, a motion goes on from that checkpoint: with
/// generalized-alpha, Radau and the explicit methods bit by bit as if it had never been interrupted. All is
/// in the model's own coordinates.
SimulationReport simulate(std::shared_ptr<const BeamModel> model, const std::vector<ProbePlace>& probes,
                          const SimulationOptions& options, const SimulationObserver& observer,
                          const Checkpoint* from = nullptr);
/// Runs a copy of the model.
SimulationReport simulate(const BeamModel& model, const std::vector<ProbePlace>& probes,
                          const SimulationOptions& options, const SimulationObserver& observer,
                          const Checkpoint* from = nullptr);

}  // namespace nurbeam
