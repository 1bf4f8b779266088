#include "fem/sensitivity/neighbouring_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

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

// Whether what acts on elements is given over time.
bool has_tables(const BeamModel& model) {
  return std::any_of(
             model.forces.begin(), model.forces.end(),
             [](const Force& force) { return std::holds_alternative<LineLoad>(force); }) ||
         std::any_of(
             model.beams.begin(), model.beams.end(),
             [](const Beam& beam) { return !beam.properties.free_strain.thermal.empty(); });
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

std::vector<bool> differing_elements(const BeamSystem& system, const BeamSystem& other, const State& state) {
  constexpr double round_off = 1e-12;
  const bool always = has_tables(system.model());
  // Strained and moving everywhere, so that whatever differs is felt.
  State near = state;
  const Eigen::VectorXd scale = system.coordinate_scale();
  for (int i = 0; i < system.coordinate_count(); ++i) {
    near.q[i] += 1e-3 * scale[i] * std::sin(1 + 1.7 * i);
    near.v[i] += scale[i] * std::sin(2 + 2.3 * i);
    near.a[i] += scale[i] * std::sin(3 + 3.1 * i);
  }
  return with_assembly(system, [&](const auto& assembly) {
    const auto& neighbour = *other.assembly<std::decay_t<decltype(assembly)>::dimension>();
    const auto forces = assembly.element_forces(near), of_other = neighbour.element_forces(near);
    std::vector<bool> differ;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const double size = forces[i].template lpNorm<Eigen::Infinity>();
      const double change = (forces[i] - of_other[i]).template lpNorm<Eigen::Infinity>();
      differ.push_back(always || assembly.elements()[i].twist || !(change <= round_off * size));
    }
    return differ;
  });
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
