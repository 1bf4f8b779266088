// Differences between two assemblies of one mesh.
#include <algorithm>
#include <optional>

#include "fem/system/assembly.h"

namespace nurbeam {

template <int D>
std::vector<bool> Assembly<D>::elements_unlike(const Assembly& other, const std::vector<State>& states,
                                               const std::vector<std::optional<bool>>& known) const {
  constexpr double rounding = 1e-12;
  const auto has_unlike_sections = [&](const MeshElement<D>& e, const MeshElement<D>& of_other) {
    if constexpr (D == 3)
      if (e.twist)
        return std::any_of(states.begin(), states.end(), [&](const State& state) {
          const TwistLayout::Coordinates own = e.twist->element.force(gather_twist(e, state));
          return !((own - of_other.twist->element.force(gather_twist(of_other, state))).norm() <=
                   rounding * own.norm());
        });
    return false;
  };
  std::vector<bool> unlike;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const MeshElement<D>&e = elements_[i], &of_other = other.elements_[i];
    const int beam = e.span->beam;
    if (!known.empty() && known[i])
      unlike.push_back(*known[i]);
    else
      unlike.push_back(!same_axis(e, of_other, model_->beams[beam], other.model_->beams[beam]) ||
                       has_unlike_sections(e, of_other));
  }
  return unlike;
}

template <int D>
bool Assembly<D>::differs_in_elements(const Assembly& other, const State& own, const State& of_other) const {
  const auto is_still = [](const BeamModel& model) {
    const auto moves = [](const Rider& rider) { return rider.motion.has_value(); };
    return std::none_of(model.constraints.begin(), model.constraints.end(), is_moved) &&
           std::none_of(model.riders.begin(), model.riders.end(), moves);
  };
  const auto are_of_bodies = [](const std::vector<BoundForce<D>>& forces) {
    const auto is_body = [](const auto& force) { return offers_of<decltype(force)>.is_body; };
    return std::all_of(forces.begin(), forces.end(),
                       [&](const BoundForce<D>& force) { return std::visit(is_body, force); });
  };
  if (!are_of_bodies(forces_) || !are_of_bodies(other.forces_) || !is_still(*model_) ||
      !is_still(*other.model_))
    return false;
  const auto ties = [](const Assembly& assembly, const State& state) {
    Eigen::VectorXd both = Eigen::VectorXd::Zero(state.q.size() + state.lambda.size());
    assembly.add_forces_and_constraints(state, both.head(state.q.size()), both.tail(state.lambda.size()));
    return both;
  };
  constexpr double round_off = 1e-13;
  const Eigen::VectorXd here = ties(*this, own), there = ties(other, of_other);
  return (here - there).template lpNorm<Eigen::Infinity>() <=
         round_off * here.template lpNorm<Eigen::Infinity>();
}

template <int D>
Eigen::VectorXd Assembly<D>::sides(const State& state) const {
  const MeshedBeams<D> at = beams();
  Eigen::VectorXd sides =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(elements_.size() + model_->connectors.size()));
  bool has_kinks = false;
  for (const MeshElement<D>& e : elements_) {
    if (!(e.element.properties().tension_damping > 0)) continue;
    has_kinks = true;
    sides[e.index] = e.element.is_taut(gather<D>(e, state)) ? 1 : 0;
  }
  for (const BoundForce<D>& force : forces_)
    std::visit(
        [&](const auto& f) {
          if constexpr (offers_of<decltype(f)>.connector) {
            if (!f.carries_one_sign(at)) return;
            has_kinks = true;
            sides[f.side(at)] = f.carries(at, state) ? 1 : 0;
          }
        },
        force);
  return has_kinks ? sides : Eigen::VectorXd();
}

template Eigen::VectorXd Assembly<2>::sides(const State&) const;
template Eigen::VectorXd Assembly<3>::sides(const State&) const;
template std::vector<bool> Assembly<2>::elements_unlike(const Assembly&, const std::vector<State>&,
                                                        const std::vector<std::optional<bool>>&) const;
template std::vector<bool> Assembly<3>::elements_unlike(const Assembly&, const std::vector<State>&,
                                                        const std::vector<std::optional<bool>>&) const;
template bool Assembly<2>::differs_in_elements(const Assembly&, const State&, const State&) const;
template bool Assembly<3>::differs_in_elements(const Assembly&, const State&, const State&) const;

}  // namespace nurbeam
