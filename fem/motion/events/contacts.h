#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "fem/motion/events/impacts.h"
#include "fem/motion/record/run_event.h"
#include "fem/motion/remesh/meshed_state.h"

/// Contacts of bodies with stops, and with each other.
namespace nurbeam {

/// A contact event at a stop, or between two bodies without one.
struct ContactEvent {
  enum class Kind {
    hits,    ///< a body comes to a stop, hard or with a buffer
    leaves,  ///< a body at rest against a hard stop is no longer pressed to it, or a body comes off a buffer
    bodies_meet  ///< two bodies on a guide without a stop between them
  };
  Kind kind;
  int stop = -1;
  /// For bodies that meet: their riders, and the lead of the second over the first at that moment.
  /// `from_more`: the lead comes down to this value, not up to it.
  std::pair<int, int> riders = {-1, -1};
  double lead = 0;  ///< [m]
  bool from_more = true;
  double part = 0;  ///< approximate part of the step at which it happens
};

/// The first contact event between two states of the system. `nothing_leaves`: bodies at rest against a hard
/// stop stay there.
std::optional<ContactEvent> first_contact(const BeamSystem& system, const State& before, const State& after,
                                          bool nothing_leaves);
/// Distance of a state of the step beyond the event, negative before it; within the tolerance the state is at
/// the event.
double beyond(const BeamSystem& system, const State& before, const State& state, const ContactEvent& event);
double tolerance(const BeamSystem& system, const State& before, const ContactEvent& event);

/// Whether a body is at a hard stop and moves on into it.
bool runs_into(const MeshedState& at, int stop, double step);
/// Finds the stops at which bodies press when the run begins. Buffers go into the memory; hard stops that a
/// body at rest is pushed against go into the plan. A body that runs into a stop counts as not yet there.
/// False where the mass matrix is singular.
[[nodiscard]] bool start_contacts(MeshedState& at, double step);
/// Applies a contact event at a stop, but not a meeting of bodies. At a hard stop velocities across it are
/// reversed times its restitution, by one impulse on all that is connected. A rebound that would end within a
/// hundredth of `step` does not take place: the body rests there. So does a body that is pressed there
/// already as a step begins.
///
/// Returns the kind of the event; nothing where the mass matrix is singular.
std::optional<EventKind> apply(MeshedState& at, const ContactEvent& event, double step, Arrival arrival);

}  // namespace nurbeam
