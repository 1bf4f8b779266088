#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fem/motion/run/simulation.h"
#include "pipelines/results/history_columns.h"
#include "pipelines/results/run_extremes.h"
#include "pipelines/run/contact_records.h"
#include "pipelines/run/history_rows.h"
#include "pipelines/run/run_checks.h"
#include "python/built_case.h"
#include "python/interrupts.h"
#include "python/laws.h"
#include "python/recording.h"
#include "python/signal.h"
#include "python/turns.h"

namespace nurbeam::python {

/// A run of motion or statics that is taken step by step, and records its snapshots. Its functions are called
/// with the interpreter's lock, which they let go while they compute. One thread at a time advances it:
/// another one gets std::runtime_error. Threads that ask for its state wait for the end of a step; a law that
/// does, in the middle of one, gets std::runtime_error. Snapshots are appended with the interpreter's lock.
class LiveRun {
 public:
  /// `start` may be null. Throws std::invalid_argument where it is of another model.
  LiveRun(std::shared_ptr<BuiltCase> of, const Functions& functions, const Checkpoint* start);

  /// Takes the next step; whether more are to come. Ctrl-C is answered before it.
  bool step();
  /// Goes on to the next output time and gives its snapshot; nothing when there is none.
  std::optional<Frame> next();

  /// Those of the last step.
  double time() const { return time_; }
  bool begun() const { return begun_; }
  bool ended() const { return ended_; }
  const std::shared_ptr<BuiltCase>& of() const { return of_; }
  const std::shared_ptr<Recording>& recording() const { return recording_; }
  /// What it has come to, and what is to be said of it.
  std::pair<SimulationReport, std::vector<Diagnostic>> report() const;
  Checkpoint checkpoint() const;
  /// What `read(simulation)` returns, between two steps.
  template <class Read>
  auto between_steps(Read read) const {
    const Moment moment(*this);
    return read(simulation_);
  }
  std::vector<RunExtreme> extremes() const;
  /// As run.json has them.
  std::string collectors() const;
  /// The present state as a snapshot of its own.
  Frame now() const;
  /// Values of histories at the present moment, by their names; NaN where there is none. Only what they need
  /// is computed. Throws std::invalid_argument for a name that is unknown.
  std::vector<double> values(const std::vector<std::string>& names) const;
  /// From now on `signal` has this value and slope, until a time, as Signal::set.
  void set_signal(Signal& signal, const Eigen::Vector3d& value, const Eigen::Vector3d& slope, double until);
  /// Gives a load of the model another value, in world coordinates.
  void change_load(std::size_t number, const Eigen::Vector3d& value);

 private:
  /// The right to advance it.
  class Advance;
  /// A moment between two steps, which lasts as long as this lives.
  class Moment {
   public:
    explicit Moment(const LiveRun& run);
    ~Moment();
    Moment(const Moment&) = delete;
    Moment& operator=(const Moment&) = delete;

   private:
    Turns& turns_;
  };
  bool advance();
  void keep_row(double before);

  std::shared_ptr<BuiltCase> of_;
  std::shared_ptr<Recording> recording_;
  FrameChecks checks_;
  RunExtremes extremes_;
  HistoryRows rows_;
  ContactRecords contacts_;
  Interrupts interrupts_;
  std::atomic<bool> begun_ = false, ended_ = false;
  Simulation simulation_;
  std::atomic<double> time_;
  std::vector<ChangedLoad> changed_loads_;
  std::size_t given_ = 0;  // snapshots
  std::vector<HistoryColumn> columns_;
  std::atomic_flag busy_;
  std::unique_ptr<Turns> turns_ = std::make_unique<Turns>();
};

}  // namespace nurbeam::python
