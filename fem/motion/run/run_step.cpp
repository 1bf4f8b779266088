#include "fem/motion/run/run_step.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "fem/forces/memory.h"
#include "fem/motion/events/friction_modes.h"
#include "fem/motion/remesh/sliding_bodies.h"
#include "fem/motion/run/damper_settling.h"
#include "fem/motion/run/run_mesh.h"
#include "fem/motion/run/run_passing.h"
#include "fem/motion/run/run_peaks.h"

namespace nurbeam {

namespace {

// Whether a cubic between the states of a step is accurate: see StepPath.
bool is_cubic(const Run& run) { return !std::holds_alternative<GeneralizedAlpha>(run.options.integrator); }

// Takes a step of the integrator of at most that length. Under error control a step that creates energy, as a
// wrong root of a snap does, counts as failed.
StepReport step_keeping_energy(Run& run, const IntegratorHistory& history, double step) {
  constexpr int most_halvings = 12;
  const State& before = run.at.state;
  StepReport taken = run.integrator->advance(step);
  for (int i = 0; taken.status == StepStatus::converged && !run.options.step; ++i) {
    const StepPath path{before, run.integrator->state(), run.integrator->within(), is_cubic(run)};
    if (!run.account.creates_energy(*run.at.system, path, run.restarted, run.report)) break;
    const StepReport refused = taken;
    run.integrator->restore(before, history);
    if (i < most_halvings)
      taken = run.integrator->advance(refused.step / 2);
    else
      taken.status = StepStatus::inaccurate;
    taken.newton_iterations += refused.newton_iterations;
    taken.rejected += refused.rejected + 1;
  }
  return taken;
}

// Repeats the step so that it ends just before a place.
void land_at(Run& run, const StepTaken& taken, const Crossing& crossing) {
  State landing = landed(*run.at.system, *run.integrator, taken, crossing);
  run.at.state = std::move(landing);
}

// Whether a model can have events: by friction, stops and connectors, or by bodies on guides.
bool has_events(const BeamModel& model) {
  return MemoryPlaces(model).size > 0 ||
         std::any_of(
             model.beams.begin(), model.beams.end(), [](const Beam& beam) { return beam.rigid; });
}

// Whether a step may be taken back: to a place or an event, by error control, or for neighbours that follow.
bool may_be_repeated(const Run& run) {
  return !run.options.step || run.observer.follower || !run.model->riders.empty() || has_events(*run.model);
}

std::size_t kinds_of_event(const BeamModel& model) {
  return model.riders.size() + model.stops.size() + model.connectors.size();
}

// Number of events in a row at one moment that count as endless.
std::size_t most_at_once(const BeamModel& model) { return 100 * (1 + kinds_of_event(model)); }

// The failure of endless events; an event of a connector belongs to no one body.
Failure endless(const Run& run, const StepEvent& event) {
  Failure failure{.kind = Failure::Kind::step,
                  .time = run.at.state.t,
                  .places = places_of(run.at),
                  .step = StepStatus::not_converged};
  if (std::holds_alternative<TautEvent>(event)) return failure;
  failure.kind = Failure::Kind::endless_events;
  failure.rider = rider_of(*run.model, event);
  return failure;
}

// Bodies of different masses may hit each other and a stop endlessly often in no time.
Arrival arrival_at_once(const Run& run) {
  return run.events_at_once > most_at_once(*run.model) / 10 ? Arrival::in_chain : Arrival::at_once;
}

// Whether an event changes a velocity at once. A step too short to resolve it would take the velocity from
// round-off.
bool is_sudden(const BeamModel& model, const StepEvent& event) {
  const auto* contact = std::get_if<ContactEvent>(&event);
  return !contact || contact->stop < 0 || !model.stops[contact->stop].buffer;
}

// Repeats a step in which an event happens, so that it ends there. If the event is sooner than steps resolve,
// the step is taken back to its start.
std::optional<StepEvent> land_on_event(Run& run, const State& before, const IntegratorHistory& history,
                                       StepStart start) {
  std::optional<StepEvent> found;
  const BeamModel& model = *run.model;
  if (!has_events(model)) return found;
  State& state = run.at.state;
  // The first event found need not be the earliest.
  for (std::size_t i = 0; i <= kinds_of_event(model) && state.t > before.t; ++i) {
    const std::optional<StepEvent> event = first_event(*run.at.system, before, state, start);
    if (!event) break;
    const State after = state;
    state = landed(*run.at.system, *run.integrator,
                   {before, history, after, after.t - before.t, &run.report.newton_iterations}, *event);
    if (state.t - before.t < run.resolution() && is_sudden(model, *event)) state = before;
    found = event;
  }
  return found;
}

// Under error control: repeats a step at whose end a change of the mesh is due, so that it ends where the
// change falls due. Otherwise its time, and all later changes, would depend on the steps.
void land_on_change(Run& run, const StepTaken& taken) {
  const auto due = [&](const State& state) {
    return next_plan(*run.at.system, state, run.options.length_control).change != MeshChange::none;
  };
  if (run.watch.is_quiet(run.at.system, taken.after) || !due(taken.after)) return;
  double before = 0, after = 1;  // in parts of the step
  while (after - before > 1e-9) {
    const double middle = (before + after) / 2;
    (due(between(taken.before, taken.after, middle)) ? after : before) = middle;
  }
  constexpr double shortest = 1e-3;
  if (after < shortest || after > 1 - shortest) return;
  Integrator& integrator = *run.integrator;
  const IntegratorHistory whole = integrator.history();
  // A repeated step differs a little from the interpolation.
  for (double miss = 1e-8; miss < 1e-2; miss *= 10) {
    const double length = (after + miss) * taken.length;
    const StepReport repeated = integrator.repeat(taken.before, taken.history, length);
    run.report.newton_iterations += repeated.newton_iterations;
    if (repeated.status != StepStatus::converged) break;
    if (!due(integrator.state())) continue;
    run.at.state = integrator.state();
    return;
  }
  integrator.restore(run.at.state, whole);
}

// The places and events that a step has landed at.
struct Landing {
  std::optional<Crossing> crossing, ending;  // at a place; at an end of a beam
  std::optional<StepEvent> event;
};

// Repeats a step so that it ends at the earliest crossing that `find` finds for its end. The first one found
// need not be the earliest.
template <class Find>
std::optional<Crossing> land_at_first(Run& run, const State& before, const IntegratorHistory& history,
                                      const Find& find) {
  std::optional<Crossing> first;
  const State& state = run.at.state;
  for (std::size_t i = 0; i <= run.model->riders.size() && state.t > before.t; ++i) {
    const std::optional<Crossing> found = find(state);
    if (!found) break;
    first = found;
    land_at(run, {before, history, State(state), state.t - before.t, &run.report.newton_iterations}, *first);
  }
  return first;
}

Landing land(Run& run, const State& before, const IntegratorHistory& history, StepStart start) {
  MeshedState& at = run.at;
  const double step = at.state.t - before.t;
  Landing landing;
  landing.crossing = land_at_first(
      run, before, history, [&](const State& state) { return first_crossing(*at.system, before, state); });
  landing.event = land_on_event(run, before, history, start);
  if (landing.crossing && !landing.event) {
    State over = carried_over(*at.system, at.state, step, *landing.crossing);
    // An event at the place itself comes first.
    landing.event = first_event(*at.system, before, over, start);
    if (!landing.event) at.state = std::move(over);
  }
  if (landing.event) landing.crossing.reset();
  landing.ending =
      land_at_first(run, before, history, [&](const State& state) { return end_passed(*at.system, state); });
  if (!landing.crossing && !landing.event && !landing.ending && !run.options.step)
    land_on_change(run, {before, history, at.state, step});
  return landing;
}

// Distance from the event or place that a step has landed at, for states of neighbouring models too; empty
// without a landing.
std::function<double(const BeamSystem&, const State&)> distance_to(const BeamModel& model,
                                                                   const Landing& landing,
                                                                   const State& before) {
  const auto& crossing = landing.ending ? landing.ending : landing.crossing;
  if (crossing)
    return [&model, crossing](const BeamSystem& system, const State& state) {
      return distance_beyond(system, state, corresponding_crossing(*crossing, model, system.model()));
    };
  if (landing.event)
    return [event = landing.event, &before](const BeamSystem& system, const State& state) {
      return std::visit([&](const auto& e) { return beyond(system, before, state, e); }, *event);
    };
  return {};
}

// States within the step that led to the present state, or to an instant before it.
std::span<const State> states_within(const Run& run, double length) {
  constexpr double instant = 1e-5;  // part of the step
  const bool led_here = std::abs(run.at.state.t - run.integrator->state().t) <= instant * length;
  return led_here ? run.integrator->within() : std::span<const State>();
}

// Enters a step into the energy account. `length_before`: length of the step before it.
void book(Run& run, const StepPath& path, bool first, double length_before) {
  const BeamSystem& system = *run.at.system;
  const bool has_rigid_bodies = std::ranges::any_of(system.mesh().attitudes, [](int p) { return p >= 0; });
  if (run.options.step || !has_prescribed_motions(*run.model) || (!path.within.empty() && !has_rigid_bodies))
    return run.account.add_step(system, path, first, path);
  const State before = run.at_the_moment(system, path.before, length_before),
              after = run.at_the_moment(system, path.after, run.last_step);
  std::vector<State> within;
  for (const State& state : path.within) within.push_back(run.at_the_moment(system, state, run.last_step));
  run.account.add_step(system, path, first, {before, after, within, path.is_cubic});
}

// Records a step that was shortened without having failed, by the limit on moving nodes (step_limit).
void note_cut(Run& run, double asked, const StepReport& taken) {
  if (!run.options.step || taken.rejected > 0 || taken.step > asked * (1 - 1e-9)) return;
  ++run.report.cut_steps;
  run.report.shortest_cut = std::min(run.report.shortest_cut, taken.step);
}

// Applies the consequences of a landing.
bool pass(Run& run, const Landing& landing, const State& before) {
  if (landing.ending && !end_sliding(run, *landing.ending)) return false;
  note_friction(run, before, landing.event);
  if (landing.crossing && !landing.ending && !step_over(run, *landing.crossing)) return false;
  if (landing.event && !landing.ending && !pass_event(run, *landing.event, Arrival::in_step)) return false;
  if (!run.goes_on(meeting_bodies(run.at)) || !run.goes_on(excess_of_wrap(run.at))) return false;
  settle_mesh(run);
  return run.report.status == SimulationStatus::done && recentre_sections(run);
}

}  // namespace

bool take_step(Run& run, double step, double rest, bool nothing_leaves) {
  MeshedState& at = run.at;
  const IntegratorHistory history = may_be_repeated(run) ? run.integrator->history() : IntegratorHistory();
  const double asked = run.transient > 0 ? std::min(step, run.transient) : step;
  const long iterations = run.report.newton_iterations;
  const StepReport taken = step_keeping_energy(run, history, asked);
  run.report.newton_iterations += taken.newton_iterations;
  run.report.rejected_steps += taken.rejected;
  if (taken.status != StepStatus::converged)
    return run.goes_on(Failure{
        .kind = Failure::Kind::step, .time = at.state.t, .places = places_of(at), .step = taken.status});
  if (!run.options.step && !run.options.given_step) run.step = taken.next_step;
  grow_transient(run);
  ++run.report.steps;
  const double step_before = std::exchange(run.last_step, taken.step);
  note_cut(run, asked, taken);
  State before = run.integrator->take_before();
  before.t = at.state.t;  // may have been put on an output time
  at.state = run.integrator->state();
  const bool first = std::exchange(run.restarted, false);
  const double end = at.state.t;
  const Landing landing = land(run, before, history, {nothing_leaves, run.events_at_once > 0});
  if (landing.event && at.state.t == before.t) {
    if (!pass_event(run, *landing.event, arrival_at_once(run))) return false;
    if (++run.events_at_once > most_at_once(*run.model)) return run.goes_on(endless(run, *landing.event));
    // A body pressed to its stop at once stays there for this step; else it would leave and come back for
    // ever.
    return !rests_by(run, *landing.event) || take_step(run, step, rest, true);
  }
  run.events_at_once = 0;
  if (run.observer.follower)
    run.observer.follower->steps({before, history, at.state, at.state.t != end, asked, rest,
                                  distance_to(*run.model, landing, before)});
  const double length = at.state.t == end ? taken.step : at.state.t - before.t;
  run.last_record = {at.state.t, length, static_cast<int>(run.report.newton_iterations - iterations),
                     taken.rejected};
  run.steps.push_back(run.last_record);
  watch_for_peaks(run, before, first, step_before);
  look_within(run, before, step_before);
  if (landing.ending) show_arrival(run, landing.ending->rider);
  book(run, {before, at.state, states_within(run, length), is_cubic(run)}, first, step_before);
  return pass(run, landing, before);
}

}  // namespace nurbeam
