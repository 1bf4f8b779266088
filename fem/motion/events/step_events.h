#pragma once
#include <memory>
#include <optional>
#include <variant>

#include "fem/motion/events/contacts.h"
#include "fem/motion/events/friction_modes.h"
#include "fem/motion/events/taut_connectors.h"
#include "solver/steps/event.h"

namespace nurbeam {

/// The list of events at which a step ends, besides the places that bodies cross (crossing.h) and the ends of
/// beams. A new event needs a change here and nowhere else outside its own file. Each has the approximate
/// `part` of the step at which it happens, and beyond(), tolerance() and apply().
using StepEvent = std::variant<FrictionChange, ContactEvent, TautEvent>;

/// Events that cannot happen at the start of a step: see first_contact and first_friction_change.
struct StepStart {
  bool nothing_leaves, nothing_turns;
};
/// The first event between two states of the system.
std::optional<StepEvent> first_event(const BeamSystem& system, const State& before, const State& after,
                                     StepStart start);
/// The state to which a step of another length leads, just before the event; the state before the step where
/// the step begins at the event.
State landed(const BeamSystem& system, Integrator& integrator, const StepTaken& taken,
             const StepEvent& event);
/// The rider whose body an event is about. Precondition: no TautEvent.
int rider_of(const BeamModel& model, const StepEvent& event);

}  // namespace nurbeam
