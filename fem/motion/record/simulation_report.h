#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "fem/motion/record/loaded_between.h"
#include "fem/motion/record/loose_part.h"
#include "fem/motion/record/run_event.h"
#include "solver/rest/static_equilibrium.h"
#include "solver/steps/integrator.h"

namespace nurbeam {

enum class SimulationStatus { done, not_converged, interrupted };

/// Place of a sliding body in a state.
struct BodyPlace {
  int rider;
  double s, rate;  ///< [m] (on a ring in [0, length)), [m/s]
};

/// The reason why a simulation cannot go on.
struct Failure {
  enum class Kind {
    initial_velocities,  ///< velocities cannot be made consistent with the constraints
    mass_matrix,         ///< the mass matrix is singular
    step,                ///< a step fails, and shorter ones too: `step`
    /// The equations of an impact of the rider's body at the end of its beam are singular.
    impact,
    projection,       ///< the projection of velocities on a new mesh is singular
    mesh,             ///< length control finds no mesh
    mesh_energy,      ///< a change of the mesh for the rider's body would change the energy by `energy`
    energy,           ///< more energy, `energy`, has come from nowhere than all motion has
    endless_events,   ///< events of the rider's body at one moment do not end
    wrap,             ///< the beam turns by `wrap` at the rider's body, too much for its law of friction
    bodies_meet,      ///< bodies of two riders on one beam come as near as `nearest` or nearer
    equilibrium,      ///< the equilibrium is not found: `equilibrium`
    resting_place,    ///< the resting place of a sliding body is not found
    leaves_beam,      ///< the rider's body reaches a free end of its beam, where nothing holds it
    free_lengths,     ///< the free lengths of connectors are not found
    wrong_sign,       ///< `force` in the `connector` whose length the equilibrium gives has the wrong sign
    unstable_state,   ///< vibrations about the state would grow with the rate `growth`
    no_energy,        ///< the tangent is not symmetric, so that no energy belongs to it
    not_held,         ///< the tangent is singular
    nothing_buckles,  ///< the loads make nothing buckle
    eigenvalues       ///< eigenvalues are not found
  };
  Kind kind;
  double time = 0;  ///< [s]
  std::vector<BodyPlace> places = {};
  int rider = -1, other = -1;
  /// Distance between the two bodies, and the least at which a run can go on [m]
  double distance = 0, nearest = 0;
  StepStatus step = StepStatus::converged;
  StaticReport equilibrium = {};
  double energy = 0;  ///< [J]
  double wrap = 0;    ///< [rad]
  /// The longest stable step of an explicit method, which the steps exceeded; 0 where that is not the reason
  /// [s].
  double stable_step = 0;
  double growth = 0;  ///< [1/s]
  int connector = -1;
  double force = 0;                     ///< [N]
  std::optional<LoosePart> loose = {};  ///< loose part in the motion that nothing holds, where one is found
};

/// The range of an energy over the frames so far [J].
struct EnergyRange {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  void add(double energy) {
    least = std::min(least, energy);
    greatest = std::max(greatest, energy);
  }
  double width() const { return std::max(0.0, greatest - least); }
};

/// A rider whose node was given up for good, as the change of the mesh that was due beside it would have
/// changed the energy by `energy`.
struct PointForGood {
  int rider;
  double time, s, energy;  ///< [s], [m], [J]
};

/// A body at rest that needs more force along its beam than its friction can hold; 0 without friction.
struct LooseBody {
  int rider;
  double needed, bound;  ///< [N]
};

/// The outcome of a simulation, and its cost.
struct SimulationReport {
  SimulationStatus status = SimulationStatus::done;
  std::optional<Failure> failure;  ///< where status is not_converged
  double time = 0;                 ///< time reached [s]
  long steps = 0, rejected_steps = 0, newton_iterations = 0;
  /// Steps of a fixed length that were shortened, as a body would have slid too far over an element beside
  /// it; and the shortest of them [s].
  long cut_steps = 0;
  double shortest_cut = std::numeric_limits<double>::infinity();
  std::vector<PointForGood> points_for_good;
  bool diverges = false;  ///< an equilibrium was found that the model leaves when it is touched
  /// Loading under which the model snaps through or buckles, in a search for rest.
  std::optional<Loading> snap;
  std::optional<LoosePart> loose;  ///< loose part of a mechanism, at the last rest
  /// Bodies that slide as soon as the motion starts from an equilibrium that holds them: those with friction,
  /// and those for which there was no rest.
  std::vector<LooseBody> loose_bodies;
  double motion_seconds = 0, length_control_seconds = 0;
  double energy_drift = 0;       ///< largest departure of the total energy from its start [J]
  double integration_error = 0;  ///< energy drift without what events changed [J]
  /// Without bodies that are adrift, whose fall says nothing of the rest: the kinetic energy without theirs,
  /// the range of gravity's up to the first of them [J].
  double peak_kinetic_energy = 0;
  EnergyRange strain_energy, gravity_energy;
  double energy_noise = 0;  ///< from energy_noise() [J]
  std::vector<RunEvent> events;

  /// The scale for errors of the energy: the largest of the kinetic energy and of the changes of strain and
  /// gravity energy [J].
  double energy_scale() const {
    return std::max({peak_kinetic_energy, strain_energy.width(), gravity_energy.width()});
  }
  /// Possible round-off of the total energy [J].
  double energy_round_off() const {
    const auto size = [](const EnergyRange& range) {
      return range.width() > 0 || std::isfinite(range.least)
                 ? std::max(std::abs(range.least), std::abs(range.greatest))
                 : 0;
    };
    return energy_noise + 1e-11 * (peak_kinetic_energy + size(strain_energy) + size(gravity_energy));
  }

  void fail(Failure why) {
    status = SimulationStatus::not_converged;
    failure = std::move(why);
  }
};

}  // namespace nurbeam
