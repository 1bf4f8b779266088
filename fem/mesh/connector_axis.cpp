#include "fem/mesh/connector_axis.h"

#include "fem/mesh/grip_position.h"

namespace nurbeam {

template <int D>
ConnectorAxis<D>::ConnectorAxis(const Connector& connector, const Structure& structure, const Mesh& mesh) {
  for (const int i : {0, 1}) {
    const Grip& end = connector.ends[i];
    const int r = grip_position(structure, mesh, end, "connector \"" + connector.name + "\"").value_or(-1);
    for (int d = 0; d < D; ++d) dofs_.push_back(r < 0 ? -1 : r + d);
    bodies_[i] = end.body;
    points_[i] = end.point.template head<D>();
  }
  if (connector.direction) direction_ = connector.direction->template head<D>();
}

template <int D>
typename ConnectorAxis<D>::Vector ConnectorAxis<D>::difference(const Eigen::VectorXd& x,
                                                               bool of_places) const {
  Vector d = Vector::Zero();
  for (const int i : {0, 1}) {
    const int r = dofs_[i * D];
    const double sign = i == 0 ? -1 : 1;
    if (r >= 0)
      d += sign * x.segment<D>(r);
    else if (of_places)
      d += sign * points_[i];
  }
  return d;
}

template <int D>
typename ConnectorAxis<D>::Line ConnectorAxis<D>::line(const State& state) const {
  const Vector d = difference(state.q, true), rate = difference(state.v, false);
  if (direction_)
    return {direction_->dot(d), direction_->dot(rate), *direction_, Matrix::Zero(), Vector::Zero()};
  const double length = d.norm();
  // Ends in one place have no line between them.
  if (!(length > 0)) return {0, 0, Vector::Zero(), Matrix::Zero(), Vector::Zero()};
  const Vector n = d / length;
  const Matrix across = (Matrix::Identity() - n * n.transpose()) / length;
  return {length, n.dot(rate), n, across, across * rate};
}

template <int D>
void ConnectorAxis<D>::add_pull(const Vector& pull, Eigen::Ref<Eigen::VectorXd> dynamics) const {
  if (dofs_[0] >= 0) dynamics.segment<D>(dofs_[0]) -= pull;
  if (dofs_[D] >= 0) dynamics.segment<D>(dofs_[D]) += pull;
}

template <int D>
Eigen::Matrix<double, 2 * D, 2 * D> ConnectorAxis<D>::in_ends(const Matrix& in_d) const {
  Eigen::Matrix<double, 2 * D, 2 * D> K;
  K << in_d, -in_d, -in_d, in_d;
  return K;
}

template class ConnectorAxis<2>;
template class ConnectorAxis<3>;

}  // namespace nurbeam
