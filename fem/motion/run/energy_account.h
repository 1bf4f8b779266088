#pragma once
#include <optional>
#include <span>
#include <utility>

#include "fem/motion/record/simulation_report.h"
#include "fem/motion/record/snapshot.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// A step, with the states within it in order of time, if its method has some. Energies summed from state to
/// state are more accurate with them. Forces of prescribed motions belong to them, not to the state before.
struct StepPath {
  const State& before;
  const State& after;
  std::span<const State> within = {};
  /// Whether the cubic between two states is nearer to the motion than their mean is. The mean suits a method
  /// whose own energy balance is by the trapezoidal rule.
  bool is_cubic = false;
};

/// Whether places or supports have prescribed motions.
bool has_prescribed_motions(const BeamModel& model);

/// The account of a run's energy [J]: losses and input from outside since its start.
class EnergyAccount {
 public:
  EnergyAccount() = default;
  /// An account from the values of a checkpoint.
  EnergyAccount(double dissipated, double input, double start)
      : dissipated_(dissipated), input_(input), start_(start) {}

  double dissipated() const { return dissipated_; }
  double input() const { return input_; }
  double start() const { return start_; }

  /// Starts the account with the first state of the motion.
  void begin(const BeamSystem& system, const State& state);
  void lose(double energy) { dissipated_ += energy; }
  void take_in(double energy) { input_ += energy; }
  /// Adds the losses and the input of a step. `first`: the first step after a restart, whose accelerations
  /// are not consistent with its start. `forces`: the step with the multipliers that give the work of
  /// prescribed motions.
  void add_step(const BeamSystem& system, const StepPath& step, bool first, const StepPath& forces);
  /// Whether a step creates more energy than error control allows: a part of the kinetic and strain energy,
  /// or of the change of gravity energy. Steps are asked about in order.
  bool creates_energy(const BeamSystem& system, const StepPath& step, bool first,
                      const SimulationReport& report);

  /// Enters the account into a snapshot, whose total energy was the mechanical energy before.
  void enter(Snapshot& snapshot) const;
  /// Records the energy errors and energy scales of a snapshot in the report.
  void record(const Snapshot& snapshot, SimulationReport& report);
  /// The energy that has come from nowhere by this state; nothing if it is below all energy of the motion, or
  /// below `slight`. Beyond that the motion means nothing any more.
  std::optional<double> from_nowhere(const BeamSystem& system, const State& state,
                                     const SimulationReport& report, double slight) const;

 private:
  double dissipated_ = 0, input_ = 0, start_ = 0;
  std::pair<double, SystemEnergy> known_{-1, {}};  // at a time, since the last restart
};

/// The energy of bending each beam by a tenth of a radian [J].
double slight_bending(const BeamModel& model);

/// A noise level of energy [J], for beams that expand freely and models at rest, where no other energy gives
/// a scale. It is the energy in all beams of a strain of 1e-11 (round-off) or a thousandth of the thermal
/// strain, and of lifting bodies by 1e-11 of the longest beam.
double energy_noise(const BeamModel& model);

/// Whether the event of a change of the mesh changes the energy by too much. `now`: the present energy. Beams
/// with the elements and rules of the papers, which are there for comparison, may change it. `most`: over
/// what moves.
bool changes_energy(const BeamModel& model, const SystemEnergy& now, const RunEvent& event,
                    const SimulationReport& report, double most = 1e-3);

}  // namespace nurbeam
