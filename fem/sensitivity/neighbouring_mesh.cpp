#include "fem/sensitivity/neighbouring_mesh.h"

#include <stdexcept>

#include "fem/motion/run_follower.h"
#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

// Where a joint that the rest of `at` holds is in a neighbouring model [m].
double held_place(const MeshedState& at, int joint, const BeamModel& model) {
  const BeamModel& drawn = at.system->model();
  const double s = at.system->mesh().plan.places[joint];
  const SlidingJoint &own = drawn.joints[joint], &other = model.joints[joint];
  if (other.motion) return other.motion->at(at.state.t).s;
  if (s == own.s) return other.s;
  return corresponding_place(drawn.beam_of(own), s, model.beam_of(other));
}

}  // namespace

bool same_mesh(const BeamSystem& system, const BeamSystem& neighbour) {
  const MeshPlan &plan = system.mesh().plan, &other = neighbour.mesh().plan;
  bool same = system.dimension() == neighbour.dimension() &&
              system.coordinate_count() == neighbour.coordinate_count() &&
              system.constraint_count() == neighbour.constraint_count() && plan.modes == other.modes &&
              plan.closed == other.closed && plan.beams.size() == other.beams.size();
  for (std::size_t b = 0; same && b < plan.beams.size(); ++b)
    same = plan.beams[b].present == other.beams[b].present;
  return same;
}

std::vector<bool> held_joints(const BeamSystem& system) {
  std::vector<bool> held;
  for (int j = 0; j < static_cast<int>(system.model().joints.size()); ++j) {
    const bool has_row =
        with_assembly(system, [&](const auto& assembly) { return assembly.rows_of_place(j).count > 0; });
    held.push_back(has_row && !system.model().joints[j].motion);
  }
  return held;
}

std::unique_ptr<BeamSystem> at_rest_like(const MeshedState& at,
                                         const std::shared_ptr<const BeamModel>& model) {
  MeshPlan plan = at.system->mesh().plan;
  if (!plan.section_charts.empty() || !plan.weights.empty())
    throw std::runtime_error(
        "an equilibrium has no derivative here where bodies slide to it on beams with torsion or constant "
        "weights, or sections turn far");
  for (int j = 0; j < static_cast<int>(plan.places.size()); ++j) plan.places[j] = held_place(at, j, *model);
  return std::make_unique<BeamSystem>(model, std::move(plan), held_joints(*at.system));
}

}  // namespace nurbeam
