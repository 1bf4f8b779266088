#include "fem/constraints/body_on_section.h"

namespace nurbeam {

template <class Section>
std::optional<PointAction> BodyOnSection<Section>::action(const MeshedBeams<3>& at, const State& state,
                                                          const Eigen::Vector3d& y) const {
  if constexpr (!on_point) return std::nullopt;
  PointAction action = point_->action(at, state, y);
  const auto x = section_.coordinates(at, state.q);
  action.couple = arm(section_.here(at, x).template triad<double>(x)).cross(action.force);
  return action;
}

template <class Section>
ConstraintTerms<3> BodyOnSection<Section>::terms(const MeshedBeams<3>& at, const State& state,
                                                 const ConstraintTerms<3>::Multipliers* y) const {
  ConstraintTerms<3> terms = without_offset(at, state, y);
  const auto x = section_.coordinates(at, state.q);
  const auto& here = section_.here(at, x);
  constexpr int n = Section::size;
  const auto once = twist::variables<n, double>(x);
  if (!y) {
    add_arm(arm(here.template triad<Dual<n>>(once)), terms);
    return terms;
  }
  const Vector3<Dual<n, Dual<n>>> e =
      arm(here.template triad<Dual<n, Dual<n>>>(twist::variables<n, Dual<n>>(once)));
  add_arm({e[0].value, e[1].value, e[2].value}, terms);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k) terms.hessian(column_[i], column_[j]) += (*y)[k] * e[k].d[i].d[j];
  return terms;
}

template <class Section>
Eigen::Vector3d BodyOnSection<Section>::curvature(
    const MeshedBeams<3>& at, const State& state,
    const Eigen::Matrix<double, ConstraintTerms<3>::size, 1>& v) const {
  const auto x = section_.coordinates(at, state.q);
  std::decay_t<decltype(x)> rates;
  for (int i = 0; i < Section::size; ++i) rates[i] = v[column_[i]];
  const auto once = twist::moving<double, Section::size>(x, rates);
  const auto twice = twist::moving<Dual<1>, Section::size>(once, rates.template cast<Dual<1>>());
  const auto e = arm(section_.here(at, x).template triad<Dual<1, Dual<1>>>(twice));
  Eigen::Vector3d curvature(e[0].d[0].d[0], e[1].d[0].d[0], e[2].d[0].d[0]);
  if constexpr (on_point)
    for (int k = 0; k < rows; ++k) {
      const ConstraintTerms<3>::Multipliers y = ConstraintTerms<3>::Multipliers::Unit(k);
      curvature[k] += v.dot(point_->terms(at, state, &y).hessian * v);
    }
  return curvature;
}

template class BodyOnSection<FollowedNode>;
template class BodyOnSection<FollowedPoint>;

}  // namespace nurbeam
