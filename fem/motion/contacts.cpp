#include "fem/motion/contacts.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "fem/forces/memory.h"
#include "fem/mesh/stop_distance.h"
#include "fem/motion/friction_modes.h"
#include "fem/motion/sliding_bodies.h"
#include "fem/system/observables.h"
#include "solver/consistent.h"

namespace nurbeam {

namespace {

const Stop& stop_of(const BeamSystem& system, int stop) { return system.model().stops[stop]; }

double distance(const BeamSystem& system, const State& state, int stop) {
  return stop_distance(system.mesh(), stop_of(system, stop), state.q);
}
double opening_rate(const BeamSystem& system, const State& state, int stop) {
  return stop_rate(system.mesh(), stop_of(system, stop), state.v);
}

// A body is at its stop when it is nearer than this [m].
double touching(const BeamModel& model, int joint) {
  return 1e-13 * model.beam_of(model.joints[joint]).curve.length();
}

double lead(const BeamSystem& system, const State& state, std::pair<int, int> joints) {
  return *place(system, state, joints.second) - *place(system, state, joints.first);
}

double buffer_force(const BeamSystem& system, const State& state, int stop) {
  const Buffer& buffer = *stop_of(system, stop).buffer;
  return -buffer.stiffness * distance(system, state, stop) -
         buffer.damping * opening_rate(system, state, stop);
}

// Two bodies on one guide, between which there is no stop; on a ring they meet either way.
void add_meetings(const BeamSystem& system, const State& before, std::pair<int, int> joints,
                  std::vector<ContactEvent>& events) {
  const BeamModel& model = system.model();
  if (kept_apart(model, joints.first, joints.second)) return;
  const ReferenceCurve& curve = model.beam_of(model.joints[joints.first]).curve;
  const double now = lead(system, before, joints);
  const auto add = [&](double at, bool from_more) {
    events.push_back({ContactEvent::Kind::bodies_meet, -1, joints, at, from_more});
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
    const BufferContact contact = buffer_contact(model, before.memory, i);
    if (contact == BufferContact::let_go) continue;
    const bool pressed =
        model.stops[i].buffer ? contact == BufferContact::pressing : system.mesh().plan.is_closed(i);
    events.push_back({pressed ? ContactEvent::Kind::leaves : ContactEvent::Kind::hits, i});
  }
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j)
    for (int i = 0; i < j; ++i)
      if (model.joints[i].beam == model.joints[j].beam && model.beam_of(model.joints[j]).rigid &&
          place(system, before, i) && place(system, before, j))
        add_meetings(system, before, {i, j}, events);
  return events;
}

// The same model with other stops closed; coordinates are the same.
MeshedState with_contacts(const MeshedState& at, std::vector<bool> closed) {
  MeshPlan plan = present_plan(*at.system, at.state);
  plan.closed = std::move(closed);
  MeshedState next{at.system->replanned(std::move(plan)), at.state};
  next.state.lambda = Eigen::VectorXd::Zero(next.system->constraint_count());
  return next;
}

std::vector<bool> closed_contacts(const MeshedState& at) {
  std::vector<bool> closed = at.system->mesh().plan.closed;
  closed.resize(at.system->model().stops.size(), false);
  return closed;
}

constexpr double shortest_rebound = 0.01;  // of a step, that is followed

// The velocities without those across a stop that is to be kept; what else was kept and would be pulled is
// let go, unless the force that presses it would bring it back at once.
std::optional<MeshedState> stopped(const MeshedState& at, int stop, double step) {
  std::vector<bool> closed = closed_contacts(at);
  closed[stop] = true;
  for (;;) {
    MeshedState kept = with_contacts(at, closed);
    const Projection projection = project_velocities(*kept.system, kept.state, step);
    if (projection.status != ConsistencyStatus::done) return {};
    State impulse = kept.state;
    impulse.lambda = projection.impulse;
    bool pulled = false;
    for (int i = 0; i < static_cast<int>(closed.size()); ++i) {
      if (!closed[i] || i == stop) continue;
      const double pressed = std::max(0.0, contact_force(*at.system, at.state, i));
      if (contact_force(*kept.system, impulse, i) >= -pressed * shortest_rebound / 2 * step) continue;
      closed[i] = false;
      pulled = true;
    }
    if (!pulled) return kept;
  }
}

bool hit_stop(MeshedState& at, int stop, double step, bool presses) {
  const Stop& of = stop_of(*at.system, stop);
  std::optional<MeshedState> kept = stopped(at, stop, step);
  if (!kept) return false;
  std::vector<bool> closed = closed_contacts(*kept);
  closed[stop] = false;
  MeshedState open = with_contacts(*kept, closed);
  const double closing = -opening_rate(*at.system, at.state, stop);
  if (closing > 0) open.state.v = at.state.v + (1 + of.restitution) * (kept->state.v - at.state.v);
  State moving = open.state;
  if (make_accelerations_smooth(*open.system, step, moving) != ConsistencyStatus::done) return false;
  const double away = opening_rate(*open.system, open.state, stop),
               pushed = -stop_rate(open.system->mesh(), of, moving.a);
  const bool rests = (presses && closing <= 0) || (pushed > 0 && away < 2 * pushed * shortest_rebound * step);
  at = rests ? std::move(*kept) : std::move(open);
  return true;
}

// Whether a step that begins there comes to the event: from where the state is clear of it, or after it has
// left. What a hard stop pulls leaves.
bool comes_to(const BeamSystem& system, const State& before, const State& after, const ContactEvent& event) {
  const double near = tolerance(system, before, event);
  const double from = beyond(system, before, before, event), to = beyond(system, before, after, event);
  if (event.kind == ContactEvent::Kind::hits) return to > (from < -near ? 0 : near);
  const bool hard = event.kind == ContactEvent::Kind::leaves && !stop_of(system, event.stop).buffer;
  if (hard && from > near) return to > near;
  return from < -near && to > 0;
}

}  // namespace

double beyond(const BeamSystem& system, const State&, const State& state, const ContactEvent& event) {
  if (event.kind == ContactEvent::Kind::bodies_meet)
    return (event.from_more ? 1 : -1) * (event.lead - lead(system, state, event.joints));
  if (event.kind == ContactEvent::Kind::hits) return -distance(system, state, event.stop);
  return stop_of(system, event.stop).buffer ? -buffer_force(system, state, event.stop)
                                            : -contact_force(system, state, event.stop);
}

double tolerance(const BeamSystem& system, const State& before, const ContactEvent& event) {
  if (event.kind == ContactEvent::Kind::bodies_meet) return touching(system.model(), event.joints.first);
  if (event.kind == ContactEvent::Kind::hits)
    return touching(system.model(), stop_of(system, event.stop).joint);
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
    const double from = std::min(0.0, beyond(system, before, before, event)),
                 to = beyond(system, before, after, event);
    event.part = from < 0 ? from / (from - to) : 0;
    if (!first || event.part < first->part) first = event;
  }
  return first;
}

bool start_contacts(MeshedState& at, double step) {
  const BeamModel& model = at.system->model();
  for (int i = 0; i < static_cast<int>(model.stops.size()); ++i) {
    if (!is_in_place(at.system->mesh(), model.stops[i])) continue;
    if (distance(*at.system, at.state, i) > touching(model, model.stops[i].joint)) continue;
    if (model.stops[i].buffer)
      set_buffer_contact(model, at.state.memory, i, BufferContact::pressing);
    else if (!hit_stop(at, i, step, false))
      return false;
  }
  return true;
}

std::optional<EventKind> apply(MeshedState& at, const ContactEvent& event, double step, bool presses) {
  const bool hard = !stop_of(*at.system, event.stop).buffer;
  const bool hits = event.kind == ContactEvent::Kind::hits;
  if (!hard)
    set_buffer_contact(at.system->model(), at.state.memory, event.stop,
                       hits ? BufferContact::pressing : BufferContact::let_go);
  else if (hits && !hit_stop(at, event.stop, step, presses))
    return {};
  if (event.kind == ContactEvent::Kind::leaves && hard) {
    std::vector<bool> closed = closed_contacts(at);
    closed[event.stop] = false;
    at = with_contacts(at, std::move(closed));
  }
  // Forces across the beam and velocities along it have jumped.
  if (hard && !settle_friction(at, joints_with_friction(*at.system), step, false)) return {};
  if (event.kind == ContactEvent::Kind::leaves) return EventKind::leaves_stop;
  return at.system->mesh().plan.is_closed(event.stop) ? EventKind::rests_at_stop : EventKind::hits_stop;
}

}  // namespace nurbeam
