#include "fem/motion/meshed_state.h"

#include <optional>
#include <utility>
#include <vector>

#include "fem/motion/sliding_bodies.h"
#include "fem/motion/transfer.h"
#include "fem/system/initial_state.h"
#include "solver/consistent.h"

namespace nurbeam {

namespace {

// Whether a new mesh holds the motion as it is, or takes the papers' way.
bool keeps_motion(const Beam& beam, MeshChange change) {
  if (change == MeshChange::split || change == MeshChange::becomes_node)
    return beam.properties.axial_strain == AxialStrain::pointwise;
  return change == MeshChange::merge && beam.merge != MergeRule::standard;
}

// With the moves of a neighbouring motion where there are such.
MeshChangeReport change(MeshedState& at, const NextPlan& next, bool at_rest,
                        const std::vector<EnergyMove>* moves) {
  const BeamModel& model = at.system->model();
  const bool exact = at_rest || keeps_motion(model.beam_of(model.joints[next.joint]), next.change);
  const std::vector<bool> held(model.joints.size(), at_rest);
  auto to = std::make_unique<BeamSystem>(at.system->shared_model(), next.plan, held);
  std::optional<Transferred> moved;
  if (exact) {
    State carried = interpolated(*at.system, at.state, *to);
    if (close_constraints(*to, closed_enough(*at.system, at.state), carried))
      moved = Transferred{std::move(carried), {}};
  } else {
    moved = moves ? projected_like(*at.system, at.state, *to, *moves) : projected(*at.system, at.state, *to);
  }
  if (!moved)
    return {.failure =
                Failure{.kind = Failure::Kind::projection, .time = at.state.t, .places = places_of(at)}};
  at = {std::move(to), std::move(moved->state)};
  return {.impulse = std::move(moved->impulse), .moves = std::move(moved->moves)};
}

}  // namespace

MeshedState MeshedState::drawn(std::shared_ptr<const BeamModel> model) {
  MeshPlan plan = initial_plan(*model);
  auto system = std::make_unique<BeamSystem>(std::move(model), std::move(plan));
  State state = drawn_state(*system);
  return {std::move(system), std::move(state)};
}

MeshChangeReport change_mesh(MeshedState& at, const NextPlan& next, bool at_rest) {
  return change(at, next, at_rest, nullptr);
}

MeshChangeReport change_mesh_like(MeshedState& at, const NextPlan& next,
                                  const std::vector<EnergyMove>& moves) {
  return change(at, next, false, &moves);
}

std::optional<Failure> excess_of_changes(const MeshedState& at, std::size_t count) {
  const std::size_t most = 20 * (at.system->model().joints.size() + 1);
  if (count <= most + 1) return std::nullopt;
  return Failure{.kind = Failure::Kind::mesh, .time = at.state.t, .places = places_of(at)};
}

}  // namespace nurbeam
