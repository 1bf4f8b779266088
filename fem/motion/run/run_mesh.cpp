#include "fem/motion/run/run_mesh.h"

#include <chrono>
#include <optional>
#include <utility>

#include "fem/motion/events/run_events.h"
#include "fem/motion/remesh/recentring.h"
#include "fem/motion/remesh/sliding_bodies.h"

namespace nurbeam {

namespace {

// Ends the run where a change of the mesh can neither be made, at that cost of energy, nor wait.
void refuse(Run& run, const NextPlan& next, std::optional<double> cost) {
  Failure failure{.kind = Failure::Kind::projection, .time = run.at.state.t, .places = places_of(run.at)};
  if (cost) {
    failure.kind = Failure::Kind::mesh_energy;
    failure.rider = next.rider;
    failure.energy = *cost;
  }
  run.report.fail(std::move(failure));
}

// Tells a follower of a change of the mesh that was made.
void follow_change(const Run& run, const MeshedState& before, const NextPlan& next,
                   const ChangedMesh& changed) {
  const BeamSystem& system = *run.at.system;
  const auto plan_of = [&](const MeshedState& of) { return plan_like(next.plan, *of.system, of.state); };
  NeighbourSolvers solvers;
  const auto make = [&](MeshedState& of) {
    return !change_mesh_like(of, {next.change, next.rider, plan_of(of)}, system, changed.keeping, solvers);
  };
  const auto change = [&, first = true](MeshedState& of) mutable {
    // The run's own motion is changed first, before the neighbours that are found beside it.
    if (MeshedState own = before; std::exchange(first, false)) (void)make(own);
    return make(of);
  };
  if (changed.impulse.size() == 0) return run.follow(change);
  const std::vector<bool> held(run.model->riders.size(), false);
  run.observer.follower->transfers(
      run.at,
      {before, changed.keeping,
       [&](const MeshedState& of) { return of.system->replanned(plan_of(of), held, &system); }},
      change);
}

// Applies one change of the mesh if one is due and possible. A change that would cost energy waits as long as
// it can.
bool change_due_mesh(Run& run) {
  if (run.watch.is_quiet(run.at.system, run.at.state)) return false;
  const auto start = std::chrono::steady_clock::now();
  for (int first = 0;;) {
    const NextPlan next = next_plan(*run.at.system, run.at.state, run.options.length_control, first);
    run.watch.look(run.at.system, next);
    if (next.change == MeshChange::none) return false;
    MotionSums sums = motion_sums(*run.at.system, run.at.state, run.model->riders[next.rider].beam);
    RunEvent event = event_before(run.at, kind_of(next.change), next.rider, sums);
    std::optional<ChangedMesh> changed =
        run.is_as_drawn() ? changed_drawing(run.at, next) : changed_mesh(run.at, next, sums.energy);
    if (changed) {
      sums = carried_sums(sums, *run.at.system, run.at.state, *changed->now.system, changed->now.state,
                          event.beam);
      finish_event(sums, event);
    }
    if (!changed || changes_energy(*run.model, sums.energy, event, run.report)) {
      if (!can_wait(*run.at.system, run.at.state, next)) {
        const double cost = event.energy_after - event.energy_before;
        refuse(run, next, changed ? std::optional(cost) : std::nullopt);
        return false;
      }
      first = next.rider + 1;
      continue;
    }
    const bool observed = static_cast<bool>(run.observer.mesh_changed);
    const std::vector<BeamRecord> before =
        observed ? record_beams(*run.at.system, run.at.state) : std::vector<BeamRecord>{};
    const MeshedState own = std::exchange(run.at, std::move(changed->now));
    if (run.observer.follower) follow_change(run, own, next, *changed);
    if (!run.restart_balanced(changed->around)) return false;
    run.at.state = run.integrator->state();
    event.support_impulse = support_impulse(run.at, changed->impulse);
    run.note(std::move(event));
    if (observed)
      run.observer.mesh_changed(run.report.events.back(), before, record_beams(*run.at.system, run.at.state));
    run.report.length_control_seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return true;
  }
}

}  // namespace

void settle_mesh(Run& run) {
  for (std::size_t count = 1; change_due_mesh(run); ++count)
    if (!run.goes_on(excess_of_changes(run.at, count))) return;
}

bool recentre_sections(Run& run) {
  if (!recentring_due(*run.at.system, run.at.state)) return true;
  run.at = recentred(*run.at.system, run.at.state);
  run.follow([&](MeshedState& neighbour) {
    neighbour = recentred(*neighbour.system, neighbour.state, {}, &run.at.system->mesh().plan);
    return true;
  });
  if (!run.restart_balanced({})) return false;
  run.at.state = run.integrator->state();
  return true;
}

}  // namespace nurbeam
