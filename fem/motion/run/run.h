#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/record/checkpoint.h"
#include "fem/motion/remesh/meshed_state.h"
#include "fem/motion/run/energy_account.h"
#include "fem/motion/run/simulation_options.h"

namespace nurbeam {

/// A motion at one moment of a simulation: what its steps, events and changes of the mesh share. Functions of
/// it that return a bool say whether the run goes on; where it does not, the report knows why.
struct Run {
  std::shared_ptr<const BeamModel> model;
  const SimulationOptions options;
  const SimulationObserver observer;
  MeshedState at = {};
  std::unique_ptr<Integrator> integrator = {};
  double step = 1e-4;      ///< asked for next: fixed, or what error control suggests [s]
  double transient = 0;    ///< what steps may be at most while a damper that was met settles; 0: any [s]
  bool restarted = false;  ///< and no step since
  EnergyAccount account = {};
  SimulationReport report = {};
  MeshWatch watch = {};
  std::size_t events_at_once = 0;  ///< since time has last gone on
  double last_step = 0;            ///< [s]
  StepRecord last_record = {};
  std::vector<StepRecord> steps = {};  ///< since the last snapshot

  /// Does something to the state, and to those of neighbouring models that follow; whether it could be done
  /// to the run's own.
  template <class Change>
  bool change(const Change& change) {
    const bool done = change(at);
    follow(change);
    return done;
  }
  /// Tells a follower what has led to the present state.
  template <class Change>
  void follow(const Change& change) const {
    if (observer.follower) observer.follower->changes(at, change);
  }
  /// The same where neighbours are found beside the run's own motion: it goes first, from its state before.
  template <class Change>
  void follow_from(MeshedState own, const Change& change) const {
    if (!observer.follower) return;
    if (change(own)) follow(change);
  }
  /// Whether it has not moved from its drawing yet.
  bool is_as_drawn() const { return report.steps == 0 && !options.start_from_equilibrium; }
  /// New integrator from the present state, with velocities and accelerations that are consistent.
  bool restart();
  /// After a change of the mesh or its charts, which has left all but these unknowns as they were
  /// (changed_unknowns; none: any): accelerations are carried over but for what is out of balance.
  bool restart_balanced(const std::vector<int>& around);
  /// Writes an event down.
  void note(RunEvent event);
  /// A state that a step of that length has ended in, with the multipliers of the moment. Steps close the
  /// constraints' places alone: where error control changes their length the multipliers are the second
  /// differences of what that leaves of velocities, forces of the step, a tenth of them off and more. Else,
  /// and of what is followed, as derivatives are those of the step, the state itself.
  State at_the_moment(const State& state, double length) const;

  /// What of a checkpoint is the run's: the simulation adds what it has written, and the time that took.
  Checkpoint checkpoint() const;
  void go_on_from(const Checkpoint& point);

  bool goes_on(std::optional<Failure> failure);
  bool fail(Failure::Kind kind) { return goes_on(Failure{.kind = kind, .time = at.state.t}); }
  /// In the impact at the end or a break of a rider's beam.
  bool fail_in_impact(int rider);

  /// Shorter than this nothing is followed: the next step of a method for stiff systems [s].
  double shortest_time() const;
  /// A step much shorter than the others would take the round-off of positions for velocities. What is left
  /// after an event just before an output time is not worth one [s].
  double resolution() const;
  double mechanical_energy() const;

 private:
  void start_afresh(const Integrator* before);
};

}  // namespace nurbeam
