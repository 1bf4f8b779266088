// Sensitivities by neighbours whose meshes lag behind.
#include <utility>
#include <vector>

#include "fem/motion/remesh/new_elements.h"
#include "fem/sensitivity/neighbouring_mesh.h"
#include "fem/sensitivity/sensitivities_parts.h"
#include "solver/algebra/side_by_side.h"

namespace nurbeam {

void Sensitivities::Parameter::catch_up(const MeshedState& at) {
  if (!std::exchange(lags, false)) return;
  for (std::shared_ptr<const BeamSystem>* each : {&more, &less}) {
    MeshedState neighbour{(*each)->replanned(corresponding_plan(*at.system, (*each)->model()),
                                             held_joints(*at.system), at.system.get()),
                          at.state};
    stand_on_like_spans(at, neighbour);
    *each = std::move(neighbour.system);
  }
}

// Gives all neighbours the mesh of the run, before it goes on otherwise than by steps.
void Sensitivities::catch_up() {
  const MeshedState at{system_, state_};
  side_by_side(static_cast<int>(parameters_.size()),
               [&](int k) { parameters_[static_cast<std::size_t>(k)].catch_up(at); });
}

namespace {

// The kept elements without those at nodes of new elements, as their stiffness and inertia affect these
// nodes.
std::vector<int> away_from_new_elements(std::vector<int> kept, const BeamSystem& before,
                                        const BeamSystem& behind) {
  const NodeSet changed = nodes_of_new_elements(before, behind);
  for (int& element : kept) {
    if (element < 0) continue;
    const MeshSpan& span = behind.mesh().spans[static_cast<std::size_t>(element)];
    if (changed.contains({span.beam, span.node_a}) || changed.contains({span.beam, span.node_b}))
      element = -1;
  }
  return kept;
}

}  // namespace

// Lets neighbours lag that do not differ where the mesh changes; returns which. `kept`: index after the
// change of each element of before, -1 where it is gone.
std::vector<bool> Sensitivities::let_lag(const MeshedState& before, const BeamSystem& behind,
                                         const std::vector<int>& kept) {
  const auto is_drawn = [](const BeamSystem& system) {
    return system.mesh().plan.section_charts.empty() && system.mesh().plan.weights.empty();
  };
  std::vector<bool> lagging(parameters_.size(), false);
  if (is_drawn(*before.system) && is_drawn(behind))
    lagging = differences_->outlast(before.state, shifts_at(before.state),
                                    away_from_new_elements(kept, *before.system, behind));
  for (std::size_t k = 0; k < parameters_.size(); ++k)
    if (lagging[k])
      parameters_[k].lags = true;
    else
      parameters_[k].catch_up(before);
  return lagging;
}

// Moves the places of lagging neighbours in the tangents away from the corresponding ones (-1), or back to
// them (1).
void Sensitivities::shift_lagging(const State& at, double part) {
  const Shifts shifts = shifts_at(at);
  for (std::size_t k = 0; k < shifts.size(); ++k)
    for (const auto& [place, by] : shifts[k])
      if (parameters_[k].lags) tangents_.q(place, static_cast<Eigen::Index>(k)) += part * by;
}

// Derivatives of the energy gain of a state over `before`, in the elements of lagging neighbours; zero for
// others.
Eigen::RowVectorXd Sensitivities::energies_of_lagging(const State& at,
                                                      const Eigen::RowVectorXd& before) const {
  Eigen::RowVectorXd gained = differences_->energies(at) - before;
  for (std::size_t k = 0; k < parameters_.size(); ++k)
    if (!parameters_[k].lags) gained[static_cast<Eigen::Index>(k)] = 0;
  return gained;
}

// A neighbour's state beside the run, on its own system or, if it lags, on the run's, in places and
// velocities.
Sensitivities::Beside Sensitivities::beside(std::size_t k, const State& at, bool more) const {
  const Parameter& parameter = parameters_[k];
  const NeighbourPair& pair = parameter.pair;
  const double part = more ? pair.step : -pair.step;
  State state = moved_along(at, tangents_, k, part);
  if (!parameter.lags) return {more ? *parameter.more : *parameter.less, std::move(state)};
  for (const auto& [place, by] :
       shifts_of_places(*system_, at, *pair.more.model, *pair.less.model, pair.step))
    state.q[place] -= part * by;
  return {*system_, std::move(state)};
}

}  // namespace nurbeam
