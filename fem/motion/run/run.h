#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/record/checkpoint.h"
#include "fem/motion/remesh/meshed_state.h"
#include "fem/motion/run/energy_account.h"
#include "fem/motion/run/peak_watch.h"
#include "fem/motion/run/simulation_options.h"

namespace nurbeam {

/// What was shown so far of a rider on a guide: its largest speed [m/s], and the largest force across the
/// guide over its mass [m/s^2].
struct GuidePeaks {
  double pull = 0, speed = 0;
};

/// A run: a motion at one moment of a simulation, shared by its steps, events and changes of the mesh. Its
/// functions that return a bool tell whether the run goes on; where it does not, the report has the reason.
struct Run {
  std::shared_ptr<const BeamModel> model;
  const SimulationOptions options;
  const SimulationObserver observer;
  MeshedState at = {};
  std::unique_ptr<Integrator> integrator = {};
  double step = 0;         ///< length of the next step: fixed, or suggested by error control [s]
  double transient = 0;    ///< upper limit of steps while a damper that was met settles; 0: none [s]
  bool restarted = false;  ///< restarted, with no step since
  EnergyAccount account = {};
  SimulationReport report = {};
  MeshWatch watch = {};
  PeakWatch peaks = {};
  std::vector<GuidePeaks> shown_on_guides = {};  ///< of riders
  std::size_t events_at_once = 0;                ///< number of events since time last advanced
  double last_step = 0;                          ///< [s]
  StepRecord last_record = {};
  std::vector<StepRecord> steps = {};  ///< since the last snapshot

  /// Applies a change to the state, and to the states of neighbouring models that follow. Returns whether it
  /// succeeded for the run's own state.
  template <class Change>
  bool change(const Change& change) {
    const bool done = change(at);
    follow(change);
    return done;
  }
  /// Tells a follower the change that has led to the present state.
  template <class Change>
  void follow(const Change& change) const {
    if (observer.follower) observer.follower->changes(at, change);
  }
  /// Tells a follower the change where neighbours are found beside the run's own motion: `own`, the run's
  /// state before, is changed first.
  template <class Change>
  void follow_from(MeshedState own, const Change& change) const {
    if (!observer.follower) return;
    if (change(own)) follow(change);
  }
  /// Whether the model has not moved from its drawing yet.
  bool is_as_drawn() const { return report.steps == 0 && !options.start_from_equilibrium; }
  /// Starts a new integrator from the present state, with consistent velocities and accelerations.
  bool restart();
  /// Restarts after a change of the mesh or its charts, which has left all unknowns but `around` as they were
  /// (changed_unknowns; empty: any may have changed). Accelerations are carried over, except where they are
  /// out of balance.
  bool restart_balanced(const std::vector<int>& around);
  /// Restarts after a jump of velocities. What has not jumped goes on as it would without a restart.
  bool restart_after_jump();
  /// Records an event.
  void note(RunEvent event);
  /// The state with the multipliers of the present moment, at the end of a step of that length.
  ///
  /// Steps close constraints of places only. When error control varies the length of steps, the multipliers
  /// are second differences of the errors left in velocities: forces of the step, wrong by a tenth and more.
  /// With fixed steps, and with followers, whose derivatives are those of the step, the state is returned
  /// unchanged. `system`: of the state.
  State at_the_moment(const BeamSystem& system, const State& state, double length) const;

  /// The run's part of a checkpoint; the simulation adds what it has written, and the time taken.
  Checkpoint checkpoint() const;
  void go_on_from(const Checkpoint& point);

  bool goes_on(std::optional<Failure> failure);
  bool fail(Failure::Kind kind) { return goes_on(Failure{.kind = kind, .time = at.state.t}); }
  /// Fails in the impact at the end or a break of a rider's beam.
  bool fail_in_impact(int rider);

  /// The shortest time to follow: the next step of a method for stiff systems, else 0 [s].
  double shortest_time() const;
  /// The shortest step [s]. A step much shorter than the others would take the round-off of positions for
  /// velocities. Less time than this between an event and an output time is not worth a step.
  double resolution() const;
  double mechanical_energy() const;

 private:
  void start_afresh(const Integrator* before);
};

}  // namespace nurbeam
