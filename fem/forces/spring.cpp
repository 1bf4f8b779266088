#include "fem/forces/spring.h"

#include <algorithm>

namespace nurbeam {

ConnectorPull::ConnectorPull(const Connector& connector, double stretch, double rate) {
  const double sign = connector.type == ConnectorType::compression_only ? -1 : 1;
  const bool one_sided = connector.type != ConnectorType::spring;
  const double k = connector.stiffness, c = connector.damping;
  if (one_sided && !(sign * stretch > 0)) return;
  elastic = k * stretch;
  force = elastic + c * rate;
  if (one_sided && !(sign * force > 0)) {
    force = 0;
    return;
  }
  by_stretch = k;
  by_rate = c;
}

template <int D>
void Spring<D>::add_force(const MeshedBeams<D>&, const State& state,
                          Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const auto line = axis_.line(state);
  const ConnectorPull pull(*connector_, line.length - connector_->length, line.rate);
  axis_.add_pull(pull.force * line.n, dynamics);
}

template <int D>
typename Spring<D>::Matrix Spring<D>::tangent(const State& state, const TangentWeights& w) const {
  const auto line = axis_.line(state);
  const ConnectorPull pull(*connector_, line.length - connector_->length, line.rate);
  const Eigen::Matrix<double, D, 1> by_d =
      w.stiffness * (pull.by_stretch * line.n + pull.by_rate * line.rate_gradient) +
      w.damping * pull.by_rate * line.n;
  typename ConnectorAxis<D>::Matrix in_d =
      line.n * by_d.transpose() + w.stiffness * pull.force * line.curvature;
  if (!(line.length > 0) && !connector_->direction) in_d.diagonal().array() += w.stiffness * pull.by_stretch;
  return axis_.in_ends(in_d);
}

template <int D>
void Spring<D>::add_energy(const MeshedBeams<D>&, const State& state, SystemEnergy& sum) const {
  const auto line = axis_.line(state);
  const double stretch = line.length - connector_->length;
  const ConnectorPull pull(*connector_, stretch, line.rate);
  sum.spring += pull.elastic * stretch / 2;
  sum.dissipation += (pull.force - pull.elastic) * line.rate;
}

template <int D>
std::pair<double, double> Spring<D>::length_and_force(const State& state) const {
  const auto line = axis_.line(state);
  return {line.length, ConnectorPull(*connector_, line.length - connector_->length, line.rate).force};
}

template <int D>
Eigen::Matrix<double, D, 1> Spring<D>::on_body(int body, const State& state) const {
  Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero();
  const auto line = axis_.line(state);
  const Eigen::Matrix<double, D, 1> pull = length_and_force(state).second * line.n;
  for (const int end : {0, 1})
    if (axis_.body(end) == body) sum += end == 0 ? pull : Eigen::Matrix<double, D, 1>(-pull);
  return sum;
}

template class Spring<2>;
template class Spring<3>;

}  // namespace nurbeam
