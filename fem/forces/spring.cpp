#include "fem/forces/spring.h"

#include <algorithm>

#include "fem/forces/memory.h"

namespace nurbeam {

ConnectorPull::ConnectorPull(const Connector& connector, double stretch, double rate, bool taut,
                             std::optional<bool> carries) {
  const int sign = connector.sign();
  const double c = sign != 0 && !taut ? 0 : connector.damping;
  const bool stretched = carries.value_or(sign == 0 || sign * stretch > 0);
  if (!stretched && c == 0) return;
  const ForceRows::Point law = connector.elastic(stretch);
  if (stretched) {
    elastic = law.force;
    energy = law.energy;
  }
  force = law.force + c * rate;
  if (!carries.has_value() && sign != 0 && !(sign * force > 0)) {
    force = 0;
    return;
  }
  by_stretch = law.stiffness;
  by_rate = c;
}

template <int D>
ConnectorPull Spring<D>::pull(const MeshedBeams<D>& at, const Line& line, const State& state) const {
  const Connector& connector = described(at);
  const double stretch = line.length - connector.length;
  std::optional<bool> held;
  if (carries_one_sign(at) && state.sides.size() > 0) held = state.sides[side(at)] != 0;
  const bool taut = connector.jumps() && state.memory.size() > 0
                        ? is_taut(at.mesh.memory, state.memory, number_)
                        : held.value_or(connector.sign() * stretch > 0);
  return {connector, stretch, line.rate, taut, held};
}

template <int D>
bool Spring<D>::carries(const MeshedBeams<D>& at, const State& state) const {
  const Connector& connector = described(at);
  return connector.sign() == 0 || connector.sign() * (axis_.line(state).length - connector.length) > 0;
}

template <int D>
void Spring<D>::add_force(const MeshedBeams<D>& at, const State& state,
                          Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const Line line = axis_.line(state);
  axis_.add_pull(pull(at, line, state).force * line.n, dynamics);
}

template <int D>
typename Spring<D>::Matrix Spring<D>::tangent(const MeshedBeams<D>& at, const State& state,
                                              const TangentWeights& w) const {
  const Line line = axis_.line(state);
  const ConnectorPull now = pull(at, line, state);
  const Eigen::Matrix<double, D, 1> by_d =
      w.stiffness * (now.by_stretch * line.n + now.by_rate * line.rate_gradient) +
      w.damping * now.by_rate * line.n;
  typename ConnectorAxis<D>::Matrix in_d =
      line.n * by_d.transpose() + w.stiffness * now.force * line.curvature;
  if (!(line.length > 0) && !described(at).direction) in_d.diagonal().array() += w.stiffness * now.by_stretch;
  return axis_.in_ends(in_d);
}

template <int D>
void Spring<D>::add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
  const Line line = axis_.line(state);
  sum.spring += pull(at, line, state).energy;
}

template <int D>
double Spring<D>::loss(const MeshedBeams<D>& at, const State& from, const State& to) const {
  if (described(at).damping == 0) return 0;
  const Line before = axis_.line(from), after = axis_.line(to);
  const ConnectorPull first = pull(at, before, from), last = pull(at, after, from);
  return (first.force - first.elastic + last.force - last.elastic) / 2 * (after.length - before.length);
}

template <int D>
void Spring<D>::commit(const MeshedBeams<D>& at, const State& state, Eigen::VectorXd& memory) const {
  const Connector& connector = described(at);
  if (!connector.jumps() || memory.size() == 0) return;
  const Line line = axis_.line(state);
  // A connector that went slack and came back within the step pulls on: the force goes on beyond the free
  // length.
  const bool pulls = pull(at, line, state).force != 0;
  const double stretch = connector.sign() * (line.length - connector.length);
  set_taut(at.mesh.memory, memory, number_, pulls || stretch > -connector.least_stretch(line.length));
}

template <int D>
std::pair<double, double> Spring<D>::length_and_force(const MeshedBeams<D>& at, const State& state) const {
  const Line line = axis_.line(state);
  return {line.length, pull(at, line, state).force};
}

template <int D>
Eigen::Matrix<double, D, 1> Spring<D>::on_body(const MeshedBeams<D>& at, int body, const State& state) const {
  Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero();
  const Line line = axis_.line(state);
  const Eigen::Matrix<double, D, 1> force = pull(at, line, state).force * line.n;
  for (const int end : {0, 1})
    if (axis_.body(end) == body) sum += end == 0 ? force : Eigen::Matrix<double, D, 1>(-force);
  return sum;
}

template class Spring<2>;
template class Spring<3>;

}  // namespace nurbeam
