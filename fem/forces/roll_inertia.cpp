#include "fem/forces/roll_inertia.h"

namespace nurbeam {

template <class Section>
typename RollInertia<Section>::Matrix RollInertia<Section>::tangent(const MeshedBeams<3>& at,
                                                                    const State& state,
                                                                    const TangentWeights& w) const {
  using T = Dual<1>;
  const Motion<double> x = motion(at, state);
  const auto& here = section_.here(at, x.q);
  Matrix K;
  for (int j = 0; j < size; ++j) {
    const Vector<double> along = Vector<double>::Unit(j);
    const Motion<T> moved{twist::moving<double, size>(x.q, w.stiffness * along),
                          twist::moving<double, size>(x.v, w.damping * along),
                          twist::moving<double, size>(x.a, w.mass * along)};
    const Vector<T> f = here.template force<T>(moved.q, moment<T>(here, moved));
    for (int i = 0; i < size; ++i) K(i, j) = f[i].d[0];
  }
  return K;
}

template <class Section>
void RollInertia<Section>::add_force(const MeshedBeams<3>& at, const State& state,
                                     Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const Motion<double> x = motion(at, state);
  const auto& here = section_.here(at, x.q);
  add(here.template force<double>(x.q, moment<double>(here, x)), dynamics);
}

template <class Section>
double RollInertia<Section>::spin(const MeshedBeams<3>& at, const State& state) const {
  const Motion<double> x = motion(at, state);
  const auto now = section_.here(at, x.q).template triad<Dual<1>>(twist::moving<double, size>(x.q, x.v));
  double w = 0;
  for (int d = 0; d < 3; ++d) w += now.d1[d].d[0] * now.d2[d].value;
  return w;
}

template <class Section>
void RollInertia<Section>::add_momentum(const MeshedBeams<3>& at, const State& state, double spin,
                                        Eigen::Ref<Eigen::VectorXd> p) const {
  const Vector<double> x = section_.coordinates(at, state.q);
  const auto& here = section_.here(at, x);
  const Eigen::Vector3d t = here.template triad<double>(x).t;
  add(here.template force<double>(x, Vector3<double>(inertia_ * spin * t)), p);
}

template <class Section>
void RollInertia<Section>::add_actions(const MeshedBeams<3>& at, const State& state,
                                       std::vector<PointAction>& actions) const {
  if constexpr (std::is_same_v<Section, FollowedPoint>) {
    const Motion<double> x = motion(at, state);
    actions.push_back({.element = section_.element(),
                       .s = x.q[size - 1],
                       .couple = -moment<double>(section_.here(at, x.q), x)});
  }
}

template class RollInertia<FollowedNode>;
template class RollInertia<FollowedPoint>;

}  // namespace nurbeam
