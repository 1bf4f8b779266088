#pragma once
#include <optional>
#include <vector>

#include "fem/motion/record/run_event.h"
#include "fem/motion/remesh/meshed_state.h"

/// Which bodies stick to their beams and which slide.
namespace nurbeam {

/// The riders whose bodies have friction and are free to slide.
std::vector<int> joints_with_friction(const BeamSystem& system);

/// Per rider: its body rests against a hard stop, or against one that does. What friction does to it then is
/// not known, and taken for nothing.
std::vector<bool> blocked_joints(const BeamSystem& system);

/// Gives the state the memory of its forces. Of friction: bodies that move slide; those at rest stick where
/// they are with what holds them there, or slide the way that they are pulled. `step` as for
/// make_accelerations_smooth. False where the mass matrix is singular.
[[nodiscard]] bool start_memory(MeshedState& at, double step);
/// The same for some of the bodies, which the memory knows; with `at_rest` they count as that however they
/// move.
[[nodiscard]] bool settle_friction(MeshedState& at, const std::vector<int>& riders, double step,
                                   bool at_rest);

/// The same after stops have been met or left, for the bodies whose velocities that has changed, or that rest
/// against stops now or did before.
[[nodiscard]] bool settle_friction_after_contact(const MeshedState& before, MeshedState& at, double step);

/// What the friction of a body at rest holds along its beam at most, as it sticks or slides, under the
/// multipliers of the state [N].
double holding_capacity(const BeamSystem& system, const State& state, int rider, bool sticking);
/// Gives a state at rest, in which bodies are held, the memory of friction that holds them instead, but for
/// those `except`.
void hold_by_friction(MeshedState& at, const std::vector<bool>& except);
/// A body that turns round in a step while it slides, or that breaks loose.
struct FrictionChange {
  int rider;
  bool turns;   ///< else it breaks loose
  double part;  ///< of the step, about, at which it does
};
/// The first such change between two states of the system; the step began with the memory of `before`.
/// `nothing_turns`: as it began, which a body does that has come to rest just then.
std::optional<FrictionChange> first_friction_change(const BeamSystem& system, const State& before,
                                                    const State& after, bool nothing_turns);
/// How near a state of the step is to the change, negative before it; nearer than the tolerance is at it.
double beyond(const BeamSystem& system, const State& before, const State& state,
              const FrictionChange& change);
double tolerance(const BeamSystem& system, const State& before, const FrictionChange& change);
/// One that has turned round sticks or slides back; one that has broken loose slides. What it is called,
/// nothing where the mass matrix is singular. `step` as for start_memory.
std::optional<EventKind> apply(MeshedState& at, const FrictionChange& change, double step);
/// Those that stick or slide after a step as they did not before, though it did not end there.
std::vector<int> changed_ways(const BeamSystem& system, const State& before, const State& after);
/// Which way a body slides: 0 where it sticks.
int sliding_way(const BeamSystem& system, const State& state, int rider);

}  // namespace nurbeam
