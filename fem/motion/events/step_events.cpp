#include "fem/motion/events/step_events.h"

namespace nurbeam {

namespace {

double part_of(const StepEvent& event) {
  return std::visit([](const auto& e) { return e.part; }, event);
}

// Takes over an event that comes sooner.
template <class Event>
void keep_sooner(std::optional<StepEvent>& first, const std::optional<Event>& found) {
  if (found && (!first || found->part < part_of(*first))) first = *found;
}

}  // namespace

std::optional<StepEvent> first_event(const BeamSystem& system, const State& before, const State& after,
                                     StepStart start) {
  std::optional<StepEvent> first;
  keep_sooner(first, first_friction_change(system, before, after, start.nothing_turns));
  keep_sooner(first, first_contact(system, before, after, start.nothing_leaves));
  keep_sooner(first, first_taut(system, before, after));
  return first;
}

State landed(const BeamSystem& system, Integrator& integrator, const StepTaken& taken,
             const StepEvent& event) {
  const auto beyond_it = [&](const State& state) {
    return std::visit([&](const auto& e) { return beyond(system, taken.before, state, e); }, event);
  };
  const double near = std::visit([&](const auto& e) { return tolerance(system, taken.before, e); }, event);
  return land_before(integrator, taken, beyond_it, near, std::holds_alternative<ContactEvent>(event));
}

int rider_of(const BeamModel& model, const StepEvent& event) {
  if (const auto* change = std::get_if<FrictionChange>(&event)) return change->rider;
  const ContactEvent& contact = std::get<ContactEvent>(event);
  return contact.stop < 0 ? contact.riders.first : model.stops[contact.stop].rider;
}

}  // namespace nurbeam
