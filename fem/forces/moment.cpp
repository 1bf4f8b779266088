#include "fem/forces/moment.h"

#include <Eigen/Geometry>

namespace nurbeam {

TurnedVector moment_on_slope(const TurnedVector& m, const Eigen::Vector3d& rs) {
  const double A = rs.squaredNorm();
  const Eigen::Vector3d f = m.value.cross(rs) / A;
  Eigen::Matrix3d gradient;
  for (int i = 0; i < 3; ++i)
    gradient.col(i) =
        (m.value.cross(Eigen::Vector3d::Unit(i)) + m.gradient.col(i).cross(rs)) / A - f * (2 * rs[i] / A);
  return {f, gradient};
}

template <int D>
void Moment::add_force(const MeshedBeams<D>& at, const State& state,
                       Eigen::Ref<Eigen::VectorXd> dynamics) const {
  if constexpr (D == 3)
    if (works_on_section(*this, on_section, at.structure)) {
      if (const auto load = SectionLoad::of(*this, on_section, at, state, false))
        load->add_force(at, dynamics);
      return;
    }
  if (const auto p = LoadedPoint<D>::of(*this, at, state))
    p->add_force(at, p->rs, moment_on_slope(p->vector, widened<D>(p->rs.value)), dynamics);
}

template <int D>
double Moment::work(const MeshedBeams<D>& at, const State& from, const State& to) const {
  if constexpr (D == 3)
    if (works_on_section(*this, on_section, at.structure))
      return section_load_work(*this, on_section, at, from, to);
  std::optional<int> element;  // element of the first state
  bool handed_over = false;
  const auto loaded = [&](const State& state) -> std::optional<LoadedField<D>> {
    const auto p = LoadedPoint<D>::of(*this, at, state);
    if (!p) return std::nullopt;
    handed_over = p->element != element.value_or(p->element);
    element = p->element;
    return LoadedField<D>(*p, p->rs, moment_on_slope(p->vector, widened<D>(p->rs.value)), at, state);
  };
  const auto before = loaded(from), after = loaded(to);
  // When a body with a kink passes, another slope takes over the moment; this change of slope is no motion.
  return load_work<D>(before, after, speed != 0 || handed_over, to.t - from.t);
}

template <int D>
std::optional<LoadTangent<D>> Moment::tangent(const MeshedBeams<D>& at, const State& state,
                                              const TangentWeights& w) const {
  if (w.stiffness == 0) return std::nullopt;
  const auto p = LoadedPoint<D>::of(*this, at, state);
  if (!p) return std::nullopt;
  const TurnedVector f = moment_on_slope(p->vector, widened<D>(p->rs.value));
  return LoadTangent<D>{p->element, p->stiffness(p->rs, f, w.stiffness)};
}

template <int D>
void Moment::add_actions(const MeshedBeams<D>& at, const State& state,
                         std::vector<PointAction>& actions) const {
  if (const auto p = LoadedPoint<D>::of(*this, at, state))
    actions.push_back({.element = p->element, .s = p->s, .couple = p->factor * p->vector.value});
}

template void Moment::add_actions(const MeshedBeams<2>&, const State&, std::vector<PointAction>&) const;
template void Moment::add_actions(const MeshedBeams<3>&, const State&, std::vector<PointAction>&) const;
template double Moment::work(const MeshedBeams<2>&, const State&, const State&) const;
template double Moment::work(const MeshedBeams<3>&, const State&, const State&) const;
template void Moment::add_force(const MeshedBeams<2>&, const State&, Eigen::Ref<Eigen::VectorXd>) const;
template void Moment::add_force(const MeshedBeams<3>&, const State&, Eigen::Ref<Eigen::VectorXd>) const;
template std::optional<LoadTangent<2>> Moment::tangent(const MeshedBeams<2>&, const State&,
                                                       const TangentWeights&) const;
template std::optional<LoadTangent<3>> Moment::tangent(const MeshedBeams<3>&, const State&,
                                                       const TangentWeights&) const;

}  // namespace nurbeam
