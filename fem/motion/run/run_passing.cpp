#include "fem/motion/run/run_passing.h"

#include <optional>
#include <utility>
#include <vector>

#include "fem/motion/events/kinks.h"
#include "fem/motion/events/run_events.h"
#include "fem/motion/remesh/sliding_bodies.h"
#include "fem/motion/run/damper_settling.h"
#include "fem/system/momentum.h"
#include "fem/system/observables.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

// Whether the last event is that this body left its stop at this moment.
bool has_just_left(const std::vector<RunEvent>& events, const RunEvent& event) {
  return !events.empty() && events.back().kind == EventKind::leaves_stop &&
         events.back().time == event.time && events.back().body == event.body;
}

// Lets bodies with friction stick or slide by their present forces and velocities. Energy in the stick is
// lost when a body breaks loose; when it begins to stick, this energy comes from the hold before.
bool settle_sticking(Run& run, const std::vector<int>& riders, bool at_rest) {
  if (riders.empty()) return true;
  const double before = run.mechanical_energy();
  if (!settle_friction(run.at, riders, run.shortest_time(), at_rest))
    return run.fail(Failure::Kind::mass_matrix);
  const double stored = run.mechanical_energy() - before;
  if (stored > 0)
    run.account.take_in(stored);
  else
    run.account.lose(-stored);
  return true;
}

// Whether the velocity of a body jumps where it goes over to the next element. Curvature and twist jump
// there, and with them the motion of a body that follows the section; at a kink the slope jumps.
bool is_impact(const BeamModel& model, const Crossing& crossing) {
  const Rider& rider = model.riders[crossing.rider];
  if (rider.follows_section) return true;
  const Beam& beam = model.beam_of(rider);
  const int h = beam.home_at(crossing.s);
  return h >= 0 && beam.home[h].kind == NodeKind::kink;
}

// Moves a rider's body into the next element, with its energy conserved, or, where `keeping` is known, as in
// a neighbouring motion. `neighbour`, which may be null: see BeamSystem::replanned. False where velocities
// cannot be projected.
bool go_over(MeshedState& at, const Crossing& crossing, const BeamSystem* neighbour,
             std::optional<EnergyKeeping>& keeping, NeighbourSolvers& solvers) {
  const double beyond = landing_tolerance(at.system->model(), crossing.rider);
  at.state.q[at.system->mesh().riders[crossing.rider].place] =
      crossing.s + (crossing.forward ? beyond : -beyond);
  auto next = at.system->replanned(present_plan(*at.system, at.state), {}, neighbour);
  if (!is_impact(next->model(), crossing)) {
    // On a ring the rider's node may go over the seam: from last to first, or from first to last.
    State moved = interpolated(*at.system, at.state, *next);
    at = {std::move(next), std::move(moved)};
    return true;
  }
  std::optional<Transferred> moved = keeping ? projected_like(*at.system, at.state, *next, *keeping, solvers)
                                             : projected(*at.system, at.state, *next);
  if (!moved) return false;
  keeping = std::move(moved->keeping);
  at = {std::move(next), std::move(moved->state)};
  return true;
}

// Ends the sliding of a body at an end of its beam. False where the impact is singular.
bool end_sliding_at(MeshedState& at, const Crossing& ending, bool leaves, double step) {
  const int rider = ending.rider;
  MeshPlan plan = present_plan(*at.system, at.state);
  plan.places[rider] = ending.s;
  plan.modes[rider] = leaves ? Carried::free : Carried::stopped;
  const Rider& ended = at.system->model().riders[rider];
  if (ended.reel) {  // which lets the end of its beam go
    std::vector<bool>& present = plan.beams[ended.beam].present;
    present[ended.reel->at_start ? 0 : present.size() - 1] = true;
  }
  if (leaves) {
    plan.spins.resize(at.system->model().riders.size());
    plan.spins[rider] = body_motions(*at.system, at.state).spins[rider];
  }
  auto next = at.system->replanned(std::move(plan));
  State moved = interpolated(*at.system, at.state, *next);
  if (!leaves) {
    moved.q[next->mesh().riders[rider].place] = ending.s;
    if (project_velocities(*next, moved, step).status != ConsistencyStatus::done) return false;
  }
  at = {std::move(next), std::move(moved)};
  return true;
}

}  // namespace

bool pass_event(Run& run, const StepEvent& event, Arrival arrival) {
  const auto* contact = std::get_if<ContactEvent>(&event);
  if (contact && contact->kind == ContactEvent::Kind::bodies_meet)
    return run.goes_on(meeting(run.at, contact->riders.first, contact->riders.second));
  if (const auto* taut = std::get_if<TautEvent>(&event)) {
    run.change([&](MeshedState& at) {
      apply(at, *taut);
      return true;
    });
    return settle_damper(run, event) && run.restart();
  }
  RunEvent happened = event_before(run.at, EventKind::slides, rider_of(*run.model, event));
  const auto pass = [&](MeshedState& at) {
    return contact ? apply(at, *contact, run.shortest_time(), arrival)
                   : apply(at, std::get<FrictionChange>(event), run.shortest_time());
  };
  const std::optional<EventKind> kind = pass(run.at);
  if (!kind) return run.fail(Failure::Kind::mass_matrix);
  run.follow([&](MeshedState& at) { return pass(at) == kind; });
  happened.kind = *kind;
  run.account.lose(happened.energy_before - run.mechanical_energy());
  if (!settle_damper(run, event) || !run.restart()) return false;
  finish_event(run.at, happened);
  std::vector<RunEvent>& events = run.report.events;
  // A follower has been told already that the body left.
  if (arrival != Arrival::in_step && happened.kind == EventKind::rests_at_stop &&
      has_just_left(events, happened) && !run.observer.follower)
    events.pop_back();
  else
    run.note(std::move(happened));
  return true;
}

bool pass_first_impacts(Run& run) {
  for (int i = 0; i < static_cast<int>(run.model->stops.size()); ++i)
    if (runs_into(run.at, i, run.shortest_time()) &&
        !pass_event(run, ContactEvent{ContactEvent::Kind::hits, i}, Arrival::in_step))
      return false;
  return true;
}

bool rests_by(const Run& run, const StepEvent& event) {
  const auto* contact = std::get_if<ContactEvent>(&event);
  return contact && contact->kind == ContactEvent::Kind::hits &&
         run.at.system->mesh().plan.is_closed(contact->stop);
}

bool step_over(Run& run, const Crossing& crossing) {
  const bool is_hit = is_impact(*run.model, crossing);
  const double before = is_hit ? run.mechanical_energy() : 0;
  std::optional<EnergyKeeping> keeping;    // of the run, whose own motion goes over first
  std::shared_ptr<const BeamSystem> over;  // system of the run's own motion
  NeighbourSolvers solvers;
  const auto pass = [&](MeshedState& at) {
    return go_over(at, corresponding_crossing(crossing, *run.model, at.system->model()), over.get(), keeping,
                   solvers);
  };
  const MeshedState own = run.at;
  if (!pass(run.at)) return run.fail_in_impact(crossing.rider);
  over = run.at.system;
  run.follow_from(own, pass);
  if (is_hit) run.account.lose(before - run.mechanical_energy());
  return run.restart();
}

bool end_sliding(Run& run, const Crossing& ending) {
  const int rider = ending.rider;
  const bool leaves = run.model->riders[rider].leave_at_end && !is_held(*run.model, ending);
  RunEvent event = event_before(run.at, leaves ? EventKind::left_beam : EventKind::stopped_at_end, rider);
  const bool ended = run.change([&](MeshedState& at) {
    return end_sliding_at(at, corresponding_crossing(ending, *run.model, at.system->model()), leaves,
                          run.shortest_time());
  });
  if (!ended) return run.fail_in_impact(rider);
  if (!run.restart()) return false;
  finish_event(run.at, event);
  // Energy lost in the impact, or stored by friction and buffers.
  run.account.lose(event.energy_before - event.energy_after);
  run.note(std::move(event));
  return true;
}

bool pass_kink(Run& run) {
  bool jumps = support_speed_jumps(*run.model, run.at.state.t);
  for (const MotionKink& kink : motion_kinks(*run.model, run.at.state.t)) {
    if (run.at.system->mesh().plan.modes[kink.rider] == Carried::free) continue;
    const std::optional<Crossing> end =
        end_reached(*run.at.system, run.at.state, kink.rider, kink.before > 0);
    const Rider& rider = run.model->riders[kink.rider];
    // The motion goes on along the beam.
    const bool goes_on = run.at.state.t < rider.motion->rows()->rows().back().first;
    const bool leaves = end && kink.before != 0 && !goes_on && rider.leave_at_end;
    if (!leaves || is_held(*run.model, *end))
      jumps = true;
    else if (!end_sliding(run, *end))
      return false;
  }
  if (!jumps) return true;
  const double before = run.mechanical_energy();
  const bool projected = run.change([time = run.shortest_time()](MeshedState& at) {
    return project_velocities(*at.system, at.state, time).status == ConsistencyStatus::done;
  });
  if (!projected) return run.fail(Failure::Kind::mass_matrix);
  run.account.take_in(run.mechanical_energy() - before);
  return settle_sticking(run, joints_with_friction(*run.at.system), false) && run.restart_after_jump();
}

bool release_bodies(Run& run) {
  MeshPlan plan = present_plan(*run.at.system, run.at.state);
  std::vector<RunEvent> events;
  std::vector<int> released;
  for (int j = 0; j < static_cast<int>(run.model->riders.size()); ++j)
    if (plan.holds(j) && *run.model->riders[j].release <= run.at.state.t) {
      plan.held[j] = false;
      if (run.model->riders[j].friction) released.push_back(j);
      events.push_back(event_before(run.at, EventKind::released, j));
    }
  if (events.empty()) return true;
  run.change([&plan](MeshedState& at) {
    at.system = at.system->replanned(plan_like(plan, *at.system, at.state));
    at.state.lambda = Eigen::VectorXd::Zero(at.system->constraint_count());
    return true;
  });
  if (!settle_sticking(run, released, true) || !run.restart()) return false;
  for (RunEvent& event : events) {
    finish_event(run.at, event);
    run.note(std::move(event));
  }
  return true;
}

void note_friction(Run& run, const State& before, const std::optional<StepEvent>& located) {
  if (before.memory.size() == 0) return;
  for (const int j : changed_ways(*run.at.system, before, run.at.state)) {
    if (located && std::holds_alternative<FrictionChange>(*located) && rider_of(*run.model, *located) == j)
      continue;
    const bool sticks = sliding_way(*run.at.system, run.at.state, j) == 0;
    RunEvent event = event_before(run.at, sticks ? EventKind::sticks : EventKind::slides, j);
    finish_event(run.at, event);
    run.note(std::move(event));
  }
}

}  // namespace nurbeam
