#include "fem/motion/remesh/meshed_state.h"

#include <optional>
#include <utility>
#include <vector>

#include "fem/motion/remesh/sliding_bodies.h"
#include "fem/motion/remesh/transfer.h"
#include "fem/system/initial_state.h"
#include "fem/system/same_elements.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

// Whether a beam's motion is carried over without a projection: exactly, or by the papers' rule.
bool keeps_motion(const Beam& beam, MeshChange change) {
  if (change == MeshChange::split || change == MeshChange::becomes_node)
    return beam.properties.axial_strain == AxialStrain::pointwise;
  return change == MeshChange::merge && beam.merge != MergeRule::standard;
}

// The motion on the next mesh. `project(to)`: carries it over to a mesh that cannot keep it. `neighbour`,
// which may be null: see BeamSystem::replanned.
template <class Project>
std::optional<ChangedMesh> changed(const MeshedState& at, const NextPlan& next, bool at_rest,
                                   const BeamSystem* neighbour, const Project& project) {
  const BeamModel& model = at.system->model();
  const std::vector<bool> held(model.riders.size(), at_rest);
  auto to = at.system->replanned(next.plan, held, neighbour);
  if (at_rest || keeps_motion(model.beam_of(model.riders[next.rider]), next.change)) {
    State carried = interpolated(*at.system, at.state, *to);
    if (!close_constraints(*to, closed_enough(*at.system, at.state), carried)) return {};
    std::vector<int> around = changed_unknowns(*at.system, *to);
    return ChangedMesh{.now = {std::move(to), std::move(carried)}, .around = std::move(around)};
  }
  std::optional<Transferred> moved = project(*to);
  if (!moved) return {};
  std::vector<int> around = changed_unknowns(*at.system, *to);
  return ChangedMesh{{std::move(to), std::move(moved->state)},
                     std::move(moved->impulse),
                     std::move(moved->keeping),
                     std::move(around)};
}

std::optional<Failure> go_on_there(MeshedState& at, std::optional<ChangedMesh> changed) {
  if (!changed)
    return Failure{.kind = Failure::Kind::projection, .time = at.state.t, .places = places_of(at)};
  at = std::move(changed->now);
  return {};
}

}  // namespace

MeshedState MeshedState::drawn(std::shared_ptr<const BeamModel> model, const BeamSystem* like) {
  MeshPlan plan = initial_plan(*model);
  auto system =
      like ? std::make_unique<BeamSystem>(std::move(model), std::move(plan), std::vector<bool>{}, *like)
           : std::make_unique<BeamSystem>(std::move(model), std::move(plan));
  State state = drawn_state(*system);
  return {std::move(system), std::move(state)};
}

std::optional<ChangedMesh> changed_mesh(const MeshedState& at, const NextPlan& next, bool at_rest) {
  return changed(
      at, next, at_rest, nullptr, [&](const BeamSystem& to) { return projected(*at.system, at.state, to); });
}

std::optional<ChangedMesh> changed_mesh(const MeshedState& at, const NextPlan& next,
                                        const SystemEnergy& energy) {
  return changed(
      at, next, false, nullptr,
      [&](const BeamSystem& to) { return projected(*at.system, at.state, energy, to); });
}

std::optional<ChangedMesh> changed_drawing(const MeshedState& at, const NextPlan& next) {
  NeighbourSolvers solvers;
  return changed(at, next, false, nullptr,
                 [&](const BeamSystem& to) { return projected_like(*at.system, at.state, to, {}, solvers); });
}

std::optional<Failure> change_mesh(MeshedState& at, const NextPlan& next, bool at_rest) {
  return go_on_there(at, changed_mesh(at, next, at_rest));
}

std::optional<Failure> change_mesh_like(MeshedState& at, const NextPlan& next, const BeamSystem& neighbour,
                                        const EnergyKeeping& keeping, NeighbourSolvers& solvers) {
  return go_on_there(at, changed(
                             at, next, false, &neighbour,
                             [&](const BeamSystem& to) {
                               return projected_like(*at.system, at.state, to, keeping, solvers);
                             }));
}

std::optional<Failure> excess_of_changes(const MeshedState& at, std::size_t count) {
  const std::size_t most = 20 * (at.system->model().riders.size() + 1);
  if (count <= most + 1) return std::nullopt;
  return Failure{.kind = Failure::Kind::mesh, .time = at.state.t, .places = places_of(at)};
}

}  // namespace nurbeam
