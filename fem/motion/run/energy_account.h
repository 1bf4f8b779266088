#pragma once
#include <optional>
#include <span>
#include <utility>

#include "fem/motion/record/simulation_report.h"
#include "fem/motion/record/snapshot.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// A step, with states within it in order of time where its method has some: energies that go from state to
/// state are the more exact for them, and forces of motions are theirs, not those of the state before.
struct StepPath {
  const State& before;
  const State& after;
  std::span<const State> within = {};
  /// Whether the cubic between them is nearer to the motion than the mean of two, which is that of a method
  /// whose own books are by the trapezoidal rule.
  bool is_cubic = false;
};

/// Whether places are moved from outside.
bool has_prescribed_motions(const BeamModel& model);

/// The books of a run's energy [J]: what it has lost and what has come from outside since its start.
class EnergyAccount {
 public:
  EnergyAccount() = default;
  /// As a checkpoint has it.
  EnergyAccount(double dissipated, double input, double start)
      : dissipated_(dissipated), input_(input), start_(start) {}

  double dissipated() const { return dissipated_; }
  double input() const { return input_; }
  double start() const { return start_; }

  /// The motion begins with this state.
  void begin(const BeamSystem& system, const State& state);
  void lose(double energy) { dissipated_ += energy; }
  void take_in(double energy) { input_ += energy; }
  /// Books what a step loses and takes in; `first` after a restart, whose accelerations are not those of the
  /// moment. `forces`: the step with the multipliers by which motions work.
  void add_step(const BeamSystem& system, const StepPath& step, bool first, const StepPath& forces);
  /// Whether a step makes more energy than error control leaves: a part of the kinetic and strain energy, or
  /// of what gravity gave. Asked of one step after the other.
  bool creates_energy(const BeamSystem& system, const StepPath& step, bool first,
                      const SimulationReport& report);

  /// Writes the books into a snapshot, whose total energy has been the mechanical one.
  void enter(Snapshot& snapshot) const;
  /// Takes the errors and the scales of energy in a snapshot down in the report.
  void record(const Snapshot& snapshot, SimulationReport& report);
  /// Where all that moves has come from nowhere, what would follow means nothing: the energy that has, by
  /// this state; where it is more than `slight`.
  std::optional<double> from_nowhere(const BeamSystem& system, const State& state,
                                     const SimulationReport& report, double slight) const;

 private:
  double dissipated_ = 0, input_ = 0, start_ = 0;
  std::pair<double, SystemEnergy> known_{-1, {}};  // at a time, since the last restart
};

/// The energy of bending each beam by a tenth of a radian [J].
double slight_bending(const BeamModel& model);

/// The energy in all beams of strains that are round-off, 1e-11, or a thousandth of what heat makes of them,
/// and what lifts bodies by as much of the longest beam: where a beam expands freely, or nothing moves,
/// nothing else is there to compare an error with [J].
double energy_noise(const BeamModel& model);

/// A change of the mesh that changes the energy, which is this by `now`, by too much, as its event has it;
/// beams with the elements and rules of the papers, which are there for comparison, do as they do.
bool changes_energy(const BeamModel& model, const SystemEnergy& now, const RunEvent& event,
                    const SimulationReport& report);

}  // namespace nurbeam
