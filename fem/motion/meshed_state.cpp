#include "fem/motion/meshed_state.h"

#include <optional>
#include <utility>
#include <vector>

#include "fem/motion/sliding_bodies.h"
#include "nurbs/number_text.h"

namespace nurbeam {

template <int D>
MeshedState<D> as_drawn(const BeamModel& model) {
  auto system = std::make_unique<BeamSystem<D>>(model, initial_plan(model));
  State state = system->drawn_state();
  return {std::move(system), std::move(state)};
}

template <int D>
bool change_mesh(MeshedState<D>& at, const NextPlan& next, bool at_rest, Eigen::VectorXd& impulse,
                 SimulationReport& report) {
  const BeamModel& model = at.system->model();
  const bool keeps_velocities = next.change == MeshChange::merge &&
                                model.beams[model.joints[next.joint].beam].merge != MergeRule::standard;
  const bool exact = at_rest || next.change == MeshChange::split || next.change == MeshChange::becomes_node ||
                     keeps_velocities;
  const std::vector<bool> held(model.joints.size(), at_rest);
  auto to = std::make_unique<BeamSystem<D>>(model, next.plan, held);
  std::optional<State> moved = transfer<D>(*at.system, at.state, *to, exact, &impulse);
  if (!moved) {
    report.fail(SimulationStatus::not_converged,
                "velocities cannot be projected at t = " + text_of(at.state.t, 8) + " s" +
                    places_text(*at.system, at.state));
    return false;
  }
  at = {std::move(to), std::move(*moved)};
  return true;
}

template <int D>
bool check_changes(const MeshedState<D>& at, std::size_t count, SimulationReport& report) {
  const std::size_t most = 20 * (at.system->model().joints.size() + 1);
  if (count <= most + 1) return true;
  report.fail(SimulationStatus::not_converged,
              "length control finds no mesh at t = " + text_of(at.state.t, 8) + " s" +
                  places_text(*at.system, at.state));
  return false;
}

template MeshedState<2> as_drawn<2>(const BeamModel&);
template MeshedState<3> as_drawn<3>(const BeamModel&);
template bool change_mesh<2>(MeshedState<2>&, const NextPlan&, bool, Eigen::VectorXd&, SimulationReport&);
template bool change_mesh<3>(MeshedState<3>&, const NextPlan&, bool, Eigen::VectorXd&, SimulationReport&);
template bool check_changes<2>(const MeshedState<2>&, std::size_t, SimulationReport&);
template bool check_changes<3>(const MeshedState<3>&, std::size_t, SimulationReport&);

}  // namespace nurbeam
