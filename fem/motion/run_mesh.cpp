#include "fem/motion/run_mesh.h"

#include <chrono>
#include <utility>

#include "fem/motion/recentring.h"
#include "fem/motion/run_events.h"
#include "fem/motion/sliding_bodies.h"

namespace nurbeam {

namespace {

// Applies one change of the mesh if one is due and can be.
bool change_due_mesh(Run& run) {
  MeshedState& at = run.at;
  const auto start = std::chrono::steady_clock::now();
  const NextPlan next = next_plan(*at.system, at.state, run.options.length_control);
  if (next.change == MeshChange::none) return false;
  RunEvent event = event_before(at, kind_of(next.change), next.joint);
  const bool observed = static_cast<bool>(run.observer.mesh_changed);
  const std::vector<BeamRecord> before =
      observed ? record_beams(*at.system, at.state) : std::vector<BeamRecord>{};
  const MeshPlan plan = at.system->mesh().plan;
  const State state = at.state;
  const MeshChangeReport changed = change_mesh(at, next, false);
  if (!run.goes_on(changed.failure)) return false;
  run.follow([&](MeshedState& of) {
    const NextPlan same{next.change, next.joint, plan_like(next.plan, *of.system, of.state)};
    return !change_mesh_like(of, same, changed.moves).failure;
  });
  if (!run.restart()) return false;
  at.state = run.integrator->state();
  event.support_impulse = support_impulse(at, changed.impulse);
  finish_event(at, event);
  if (changes_energy(*at.system, at.state, event, run.report)) {
    run.report.fail({.kind = Failure::Kind::mesh_energy,
                     .time = at.state.t,
                     .places = places_of(at),
                     .joint = next.joint,
                     .energy = event.energy_after - event.energy_before});
    at = {std::make_unique<BeamSystem>(run.model, plan), state};
    return false;
  }
  run.note(std::move(event));
  if (observed)
    run.observer.mesh_changed(run.report.events.back(), before, record_beams(*at.system, at.state));
  run.report.length_control_seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return true;
}

}  // namespace

void settle_mesh(Run& run) {
  for (std::size_t count = 1; change_due_mesh(run); ++count)
    if (!run.goes_on(excess_of_changes(run.at, count))) return;
}

bool recentre_sections(Run& run) {
  if (!recentring_due(*run.at.system, run.at.state)) return true;
  run.change([](MeshedState& at) {
    at = recentred(*at.system, at.state);
    return true;
  });
  if (!run.restart()) return false;
  run.at.state = run.integrator->state();
  return true;
}

}  // namespace nurbeam
