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

// A change of the mesh that was tried, and its event. `changed`: empty where the motion cannot be carried
// over.
struct Trial {
  const NextPlan& next;
  RunEvent event;
  std::optional<ChangedMesh> changed = {};
  bool keeps_energy = false;  // to a thousandth of what moves
  bool nearly_keeps = false;  // to a hundredth: the mesh is fine enough for a body without a node

  std::optional<double> cost() const {
    return changed ? std::optional(event.energy_after - event.energy_before) : std::nullopt;
  }
};

Trial tried(const Run& run, const NextPlan& next) {
  MotionSums sums = motion_sums(*run.at.system, run.at.state, run.model->riders[next.rider].beam);
  Trial trial{.next = next, .event = event_before(run.at, kind_of(next.change), next.rider, sums)};
  std::optional<ChangedMesh>& changed = trial.changed;
  changed = run.is_as_drawn() ? changed_drawing(run.at, next) : changed_mesh(run.at, next, sums.energy);
  if (!changed) return trial;
  sums = carried_sums(sums, *run.at.system, run.at.state, *changed->now.system, changed->now.state,
                      trial.event.beam);
  finish_event(sums, trial.event);
  constexpr double nearly = 1e-2;
  trial.keeps_energy = !changes_energy(*run.model, sums.energy, trial.event, run.report);
  trial.nearly_keeps = !changes_energy(*run.model, sums.energy, trial.event, run.report, nearly);
  return trial;
}

// Goes on with the mesh of a trial; returns whether the run goes on.
bool accept(Run& run, Trial trial) {
  const bool observed = static_cast<bool>(run.observer.mesh_changed);
  const std::vector<BeamRecord> before =
      observed ? record_beams(*run.at.system, run.at.state) : std::vector<BeamRecord>{};
  const MeshedState own = std::exchange(run.at, std::move(trial.changed->now));
  if (run.observer.follower) follow_change(run, own, trial.next, *trial.changed);
  if (!run.restart_balanced(trial.changed->around)) return false;
  run.at.state = run.integrator->state();
  trial.event.support_impulse = support_impulse(run.at, trial.changed->impulse);
  run.note(std::move(trial.event));
  if (observed)
    run.observer.mesh_changed(run.report.events.back(), before, record_beams(*run.at.system, run.at.state));
  return true;
}

// Carries a body as a point for good where the change of the mesh that is due beside its node would cost a
// little energy and cannot wait. Where that would cost energy too, or the body makes a kink, the run ends.
bool give_up_node(Run& run, const Trial& costly) {
  const int rider = costly.next.rider;
  const auto instead = point_for_good(*run.at.system, run.at.state, run.options.length_control, rider);
  std::optional<Trial> trial;
  if (instead && costly.nearly_keeps) trial.emplace(tried(run, *instead));
  if (!trial || !trial->keeps_energy) {
    refuse(run, costly.next, costly.cost());
    return false;
  }
  run.report.points_for_good.push_back(
      {rider, run.at.state.t, costly.event.s.value_or(0), costly.cost().value_or(0)});
  return accept(run, std::move(*trial));
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
    Trial trial = tried(run, next);
    if (!trial.keeps_energy && can_wait(*run.at.system, run.at.state, next)) {
      first = next.rider + 1;
      continue;
    }
    if (!(trial.keeps_energy ? accept(run, std::move(trial)) : give_up_node(run, trial))) return false;
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
