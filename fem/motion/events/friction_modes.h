#pragma once
#include <numbers>
#include <optional>
#include <vector>

#include "fem/motion/record/run_event.h"
#include "fem/motion/record/simulation_report.h"
#include "fem/motion/remesh/meshed_state.h"

/// Friction modes: which bodies stick to their beams and which slide.
namespace nurbeam {

/// The riders whose bodies have friction and are free to slide.
std::vector<int> joints_with_friction(const BeamSystem& system);

/// Per rider: whether its body rests against a hard stop, or against a body that does. Friction on it is then
/// not known, and is taken as zero.
std::vector<bool> blocked_joints(const BeamSystem& system);

/// Gives the state the memory of its forces. Bodies with friction that move slide. Bodies at rest stick where
/// they are, with the force that holds them there, or slide the way that they are pulled: these are returned.
/// `step`: see make_accelerations_smooth. Nothing where the mass matrix is singular.
[[nodiscard]] std::optional<std::vector<LooseBody>> start_memory(MeshedState& at, double step);
/// Sets the friction memory of some of the bodies anew; with `at_rest` they count as at rest however they
/// move.
[[nodiscard]] std::optional<std::vector<LooseBody>> settle_friction(MeshedState& at,
                                                                    const std::vector<int>& riders,
                                                                    double step, bool at_rest);

/// Sets the friction memory anew after stops have been met or left: for bodies whose velocities this has
/// changed, and for bodies that rest against stops now or did before.
[[nodiscard]] bool settle_friction_after_contact(const MeshedState& before, MeshedState& at, double step);

/// The maximum friction force along its beam on a body at rest, if it sticks or slides, under the multipliers
/// of the state [N].
double holding_capacity(const BeamSystem& system, const State& state, int rider, bool sticking);
/// Gives a state at rest, in which bodies are held, the memory of friction that holds them instead, except
/// for the riders `except`.
void hold_by_friction(MeshedState& at, const std::vector<bool>& except);
/// The angle [rad] by which a beam turns at the kink of a rider's body; 0 without a kink.
double wrap(const BeamSystem& system, const State& state, int rider);
/// The largest wrap that Coulomb's law is for [rad]: its bound grows without limit towards 180 degrees.
inline constexpr double most_wrap_of_coulomb = 2 * std::numbers::pi / 3;
/// The first body with friction by Coulomb's law at a larger wrap.
[[nodiscard]] std::optional<Failure> excess_of_wrap(const MeshedState& at);

/// A body that turns round in a step while it slides, or that breaks loose.
struct FrictionChange {
  int rider;
  bool turns;   ///< false: the body breaks loose
  double part;  ///< approximate part of the step at which it changes
};
/// The first change of friction between two states of the system; the step began with the memory of `before`.
/// `nothing_turns`: no body turns round as the step begins, which a body does that has come to rest just
/// then.
std::optional<FrictionChange> first_friction_change(const BeamSystem& system, const State& before,
                                                    const State& after, bool nothing_turns);
/// Distance of a state of the step beyond the change, negative before it; within the tolerance the state is
/// at it.
double beyond(const BeamSystem& system, const State& before, const State& state,
              const FrictionChange& change);
double tolerance(const BeamSystem& system, const State& before, const FrictionChange& change);
/// Applies a change of friction. A body that has turned round sticks or slides back; a body that has broken
/// loose slides. Returns the kind of the event; nothing where the mass matrix is singular. `step`: see
/// start_memory.
std::optional<EventKind> apply(MeshedState& at, const FrictionChange& change, double step);
/// Riders whose bodies stick or slide after a step as they did not before, though it did not end there.
std::vector<int> changed_ways(const BeamSystem& system, const State& before, const State& after);
/// Direction in which a body slides, as FrictionMemory::slides: 0 where it sticks.
int sliding_way(const BeamSystem& system, const State& state, int rider);

}  // namespace nurbeam
