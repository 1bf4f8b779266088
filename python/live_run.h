#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/run/simulation.h"
#include "pipelines/run/run_checks.h"
#include "python/built_case.h"
#include "python/interrupts.h"
#include "python/laws.h"
#include "python/recording.h"

namespace nurbeam::python {

/// A run of motion or statics that is taken step by step, and records its snapshots. Its functions are called
/// with the interpreter's lock, which they let go while they compute. One thread at a time: another one gets
/// std::runtime_error.
class LiveRun {
 public:
  /// `start` may be null. Throws std::invalid_argument where it is of another model.
  LiveRun(std::shared_ptr<BuiltCase> of, const Functions& functions, const Checkpoint* start);

  /// Takes the next step; whether more are to come. Ctrl-C is answered before it.
  bool step();
  /// Goes on to the next output time and gives its snapshot; nothing when there is none.
  std::optional<Frame> next();

  double time() const { return simulation_.state().t; }
  bool begun() const { return begun_; }
  bool ended() const { return ended_; }
  const std::shared_ptr<BuiltCase>& of() const { return of_; }
  const std::shared_ptr<Recording>& recording() const { return recording_; }
  SimulationReport report() const { return simulation_.report(); }
  Checkpoint checkpoint() const;
  const FrameChecks& checks() const { return checks_; }
  const Simulation& simulation() const { return simulation_; }
  /// The present state as a snapshot of its own.
  Frame now() const;
  /// Gives a load of the model another value, in world coordinates.
  void change_load(std::size_t number, const Eigen::Vector3d& value);

 private:
  class Turn;
  bool advance();

  std::shared_ptr<BuiltCase> of_;
  std::shared_ptr<Recording> recording_;
  FrameChecks checks_;
  Interrupts interrupts_;
  bool begun_ = false, ended_ = false;
  Simulation simulation_;
  std::vector<ChangedLoad> changed_loads_;
  std::size_t given_ = 0;  // snapshots
  std::atomic_flag busy_;
};

}  // namespace nurbeam::python
