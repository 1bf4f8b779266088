#include "fem/motion/events/contacts.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "fem/forces/memory.h"
#include "fem/mesh/stop_distance.h"
#include "fem/motion/events/friction_modes.h"
#include "fem/motion/events/impacts.h"
#include "fem/motion/remesh/sliding_bodies.h"
#include "fem/system/observables.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

double lead(const BeamSystem& system, const State& state, std::pair<int, int> riders) {
  return *place(system, state, riders.second) - *place(system, state, riders.first);
}

double buffer_force(const BeamSystem& system, const State& state, int stop) {
  const Buffer& buffer = *stop_of(system, stop).buffer;
  return -buffer.stiffness * distance(system, state, stop) -
         buffer.damping * opening_rate(system, state, stop);
}

// Adds the meetings of two bodies on one guide without a stop between them; on a ring they can meet either
// way.
void add_meetings(const BeamSystem& system, const State& before, std::pair<int, int> riders,
                  std::vector<ContactEvent>& events) {
  const BeamModel& model = system.model();
  if (kept_apart(model, riders.first, riders.second)) return;
  const ReferenceCurve& curve = model.beam_of(model.riders[riders.first]).curve;
  const double now = lead(system, before, riders);
  const auto add = [&](double at, bool from_more) {
    events.push_back({ContactEvent::Kind::bodies_meet, -1, riders, at, from_more});
  };
  if (!curve.closed()) return add(0, now > 0);
  const double turns = std::floor(now / curve.length());
  add(turns * curve.length(), true);
  add((turns + 1) * curve.length(), false);
}

// The events that may come next.
std::vector<ContactEvent> possible_events(const BeamSystem& system, const State& before) {
  const BeamModel& model = system.model();
  std::vector<ContactEvent> events;
  for (int i = 0; i < static_cast<int>(model.stops.size()); ++i) {
    if (!is_in_place(system.mesh(), model.stops[i])) continue;
    const BufferContact contact = buffer_contact(system.mesh().memory, before.memory, i);
    if (contact == BufferContact::let_go) continue;
    const bool pressed =
        model.stops[i].buffer ? contact == BufferContact::pressing : system.mesh().plan.is_closed(i);
    events.push_back({pressed ? ContactEvent::Kind::leaves : ContactEvent::Kind::hits, i});
  }
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j)
    for (int i = 0; i < j; ++i)
      if (model.riders[i].beam == model.riders[j].beam && model.beam_of(model.riders[j]).rigid &&
          place(system, before, i) && place(system, before, j))
        add_meetings(system, before, {i, j}, events);
  return events;
}

// Whether the forces in a state pull a body off its stop, as the multiplier of a step suggests. For a hard
// stop the multiplier of a short step tells little: round-off of places acts as a force there.
bool is_pulled(const BeamSystem& system, const State& state, int stop) {
  if (stop_of(system, stop).buffer) return true;
  State balanced = state;
  if (make_accelerations_consistent(system, balanced) != ConsistencyStatus::done) return true;
  const BeamModel& model = system.model();
  const double mass = model.body_of(model.riders[stop_of(system, stop).rider]).mass,
               acceleration = model.gravity.norm() + balanced.a.lpNorm<Eigen::Infinity>();
  return contact_force(system, balanced, stop) < -contact_noise * mass * acceleration;
}

// Whether a step comes to the event, from a state that is clear of it or after the event has left. A body
// that its stop would pull leaves it.
bool comes_to(const BeamSystem& system, const State& before, const State& after, const ContactEvent& event) {
  const double near = tolerance(system, before, event);
  const double from = beyond(system, before, before, event), to = beyond(system, before, after, event);
  if (from < -near) return to > 0;
  if (event.kind == ContactEvent::Kind::bodies_meet) return false;
  const bool hard = event.kind == ContactEvent::Kind::leaves && !stop_of(system, event.stop).buffer;
  return to > near && (!hard || from > near);
}

}  // namespace

double beyond(const BeamSystem& system, const State&, const State& state, const ContactEvent& event) {
  if (event.kind == ContactEvent::Kind::bodies_meet)
    return (event.from_more ? 1 : -1) * (event.lead - lead(system, state, event.riders));
  if (event.kind == ContactEvent::Kind::hits) return -distance(system, state, event.stop);
  return stop_of(system, event.stop).buffer ? -buffer_force(system, state, event.stop)
                                            : -contact_force(system, state, event.stop);
}

double tolerance(const BeamSystem& system, const State& before, const ContactEvent& event) {
  if (event.kind == ContactEvent::Kind::bodies_meet) return touching(system.model(), event.riders.first);
  if (event.kind == ContactEvent::Kind::hits)
    return touching(system.model(), stop_of(system, event.stop).rider);
  constexpr double share = 1e-9;
  const std::optional<Buffer>& buffer = stop_of(system, event.stop).buffer;
  if (!buffer) return share * std::abs(beyond(system, before, before, event));
  return share * (buffer->stiffness * std::abs(distance(system, before, event.stop)) +
                  buffer->damping * std::abs(opening_rate(system, before, event.stop)));
}

std::optional<ContactEvent> first_contact(const BeamSystem& system, const State& before, const State& after,
                                          bool nothing_leaves) {
  std::optional<ContactEvent> first;
  for (ContactEvent& event : possible_events(system, before)) {
    const bool stays =
        nothing_leaves && event.kind == ContactEvent::Kind::leaves && !stop_of(system, event.stop).buffer;
    if (stays || !comes_to(system, before, after, event)) continue;
    if (event.kind == ContactEvent::Kind::leaves && !is_pulled(system, after, event.stop)) continue;
    const double from = std::min(0.0, beyond(system, before, before, event)),
                 to = beyond(system, before, after, event);
    event.part = from < 0 ? from / (from - to) : 0;
    if (!first || event.part < first->part) first = event;
  }
  return first;
}

bool runs_into(const MeshedState& at, int stop, double step) {
  return !stop_of(*at.system, stop).buffer && touches(*at.system, at.state, stop) &&
         opening_rate(*at.system, at.state, stop) < -unnoticed_speed(at, stop, step);
}

bool start_contacts(MeshedState& at, double step) {
  const BeamModel& model = at.system->model();
  for (int i = 0; i < static_cast<int>(model.stops.size()); ++i) {
    if (!touches(*at.system, at.state, i) || runs_into(at, i, step)) continue;
    if (model.stops[i].buffer)
      set_buffer_contact(at.system->mesh().memory, at.state.memory, i, BufferContact::pressing);
    else if (std::optional<MeshedState> next = hit_stop(at, i, step, Arrival::in_step))
      at = std::move(*next);
    else
      return false;
  }
  return true;
}

std::optional<EventKind> apply(MeshedState& at, const ContactEvent& event, double step, Arrival arrival) {
  const bool hits = event.kind == ContactEvent::Kind::hits;
  if (stop_of(*at.system, event.stop).buffer) {
    set_buffer_contact(at.system->mesh().memory, at.state.memory, event.stop,
                       hits ? BufferContact::pressing : BufferContact::let_go);
    return hits ? EventKind::hits_stop : EventKind::leaves_stop;
  }
  std::optional<MeshedState> next =
      hits ? hit_stop(at, event.stop, step, arrival) : with_contact(at, event.stop, false);
  if (!next || !settle_friction_after_contact(at, *next, step)) return {};
  at = std::move(*next);
  if (!hits) return EventKind::leaves_stop;
  return at.system->mesh().plan.is_closed(event.stop) ? EventKind::rests_at_stop : EventKind::hits_stop;
}

}  // namespace nurbeam
