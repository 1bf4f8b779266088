#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "fem/motion/events/impacts.h"
#include "fem/motion/record/run_event.h"
#include "fem/motion/remesh/meshed_state.h"

/// Bodies that meet stops, and each other.
namespace nurbeam {

/// What happens at a stop, or between two bodies without one.
struct ContactEvent {
  enum class Kind {
    hits,        ///< a body comes to a stop, hard or with a buffer
    leaves,      ///< one that rests against a hard stop is no longer pressed to it, or comes off a buffer
    bodies_meet  ///< on a guide, without a stop between them
  };
  Kind kind;
  int stop = -1;
  /// Of bodies that meet: their riders, and how far the second is ahead of the first then, from more or from
  /// less.
  std::pair<int, int> riders = {-1, -1};
  double lead = 0;  ///< [m]
  bool from_more = true;
  double part = 0;  ///< of the step, about, at which it happens
};

/// The first of them between two states of the system; `nothing_leaves`: what rests against a hard stop
/// stays.
std::optional<ContactEvent> first_contact(const BeamSystem& system, const State& before, const State& after,
                                          bool nothing_leaves);
/// How near a state of the step is to the event, negative before it; nearer than the tolerance is at it.
double beyond(const BeamSystem& system, const State& before, const State& state, const ContactEvent& event);
double tolerance(const BeamSystem& system, const State& before, const ContactEvent& event);

/// Whether a body is at a hard stop and moves on into it.
bool runs_into(const MeshedState& at, int stop, double step);
/// The stops at which bodies press when the run begins: buffers into the memory, hard ones that a body at
/// rest is pushed against into the plan. What runs into one is none of these. False where the mass matrix is
/// singular.
[[nodiscard]] bool start_contacts(MeshedState& at, double step);
/// What happens to bodies at a stop; not of bodies that meet. At a hard one velocities across it turn round
/// times its restitution, by one impulse on all that is connected. A rebound that would end within a
/// hundredth of `step` is none: the body rests there, as it does where it is pressed already as a step
/// begins. What it is called, nothing where the mass matrix is singular.
std::optional<EventKind> apply(MeshedState& at, const ContactEvent& event, double step, Arrival arrival);

}  // namespace nurbeam
