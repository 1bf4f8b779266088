#include "fem/forces/rotational_spring.h"

#include <cmath>

namespace nurbeam {

// Where nothing is remembered, the angle is within 180 degrees of the drawing.
template <int D>
double RotationalSpring<D>::counted(const MeshedBeams<D>& at, const EndAngle<D>& angle,
                                    const State& state) const {
  return angle.next_to(state.memory.size() > 0 ? state.memory[at.mesh.memory.angles[number_]] : 0);
}

template <int D>
typename RotationalSpring<D>::Ends::Vector RotationalSpring<D>::forces(const MeshedBeams<D>& at,
                                                                       const State& state) const {
  const RotationalConnector& connector = described(at);
  const typename Ends::Vector x = ends_.gathered(state.q), v = ends_.gathered(state.v);
  if (!ends_.counts()) return ends_.ball(x, v, connector.stiffness, connector.damping).all;
  const EndAngle<D> angle = ends_.angle(x, false);
  const double moment =
      connector.elastic_moment(counted(at, angle, state)) + connector.damping * angle.gradient.dot(v);
  return moment * angle.gradient;
}

template <int D>
void RotationalSpring<D>::add_force(const MeshedBeams<D>& at, const State& state,
                                    Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const typename Ends::Vector f = forces(at, state);
  for (int i = 0; i < Ends::size; ++i)
    if (dofs()[i] >= 0) dynamics[dofs()[i]] += f[i];
}

template <int D>
typename RotationalSpring<D>::Ends::Matrix RotationalSpring<D>::tangent(const MeshedBeams<D>& at,
                                                                        const State& state,
                                                                        const TangentWeights& w) const {
  const RotationalConnector& connector = described(at);
  const typename Ends::Vector x = ends_.gathered(state.q), v = ends_.gathered(state.v);
  if (!ends_.counts())
    return ends_.ball_tangent(x, v, connector.stiffness, connector.damping, w.stiffness, w.damping);
  const EndAngle<D> angle = ends_.angle(x, true);
  const double moment =
      connector.elastic_moment(counted(at, angle, state)) + connector.damping * angle.gradient.dot(v);
  const typename Ends::Vector by_x =
      w.stiffness * (connector.stiffness * angle.gradient + connector.damping * angle.hessian * v) +
      w.damping * connector.damping * angle.gradient;
  return angle.gradient * by_x.transpose() + w.stiffness * moment * angle.hessian;
}

template <int D>
void RotationalSpring<D>::add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
  const RotationalConnector& connector = described(at);
  const typename Ends::Vector x = ends_.gathered(state.q);
  if (ends_.counts())
    sum.spring += connector.energy(counted(at, ends_.angle(x, false), state));
  else
    sum.spring += connector.stiffness / 2 * std::pow(ends_.ball(x, Ends::Vector::Zero(), 0, 0).angle, 2);
}

template <int D>
double RotationalSpring<D>::loss(const MeshedBeams<D>& at, const State& from, const State& to) const {
  const RotationalConnector& connector = described(at);
  if (connector.damping == 0) return 0;
  const typename Ends::Vector x_from = ends_.gathered(from.q), x_to = ends_.gathered(to.q),
                              v_from = ends_.gathered(from.v), v_to = ends_.gathered(to.v);
  if (!ends_.counts()) {
    const auto first = ends_.ball(x_from, v_from, 0, connector.damping),
               last = ends_.ball(x_to, v_to, 0, connector.damping);
    return (first.all + last.all).dot(x_to - x_from) / 2;
  }
  const EndAngle<D> first = ends_.angle(x_from, false), last = ends_.angle(x_to, false);
  const double angle = counted(at, first, from);
  return connector.damping / 2 * (first.gradient.dot(v_from) + last.gradient.dot(v_to)) *
         (last.next_to(angle) - angle);
}

template <int D>
void RotationalSpring<D>::commit(const MeshedBeams<D>& at, const State& state,
                                 Eigen::VectorXd& memory) const {
  if (!ends_.counts() || memory.size() == 0) return;
  memory[at.mesh.memory.angles[number_]] = counted(at, ends_.angle(ends_.gathered(state.q), false), state);
}

template <int D>
std::pair<double, double> RotationalSpring<D>::angle_and_moment(const MeshedBeams<D>& at,
                                                                const State& state) const {
  const RotationalConnector& connector = described(at);
  const typename Ends::Vector x = ends_.gathered(state.q), v = ends_.gathered(state.v);
  if (!ends_.counts()) {
    const double angle = ends_.ball(x, v, 0, 0).angle;
    return {angle, connector.stiffness * angle};
  }
  const EndAngle<D> angle = ends_.angle(x, false);
  const double phi = counted(at, angle, state);
  return {phi, connector.elastic_moment(phi) + connector.damping * angle.gradient.dot(v)};
}

template <int D>
bool RotationalSpring<D>::admissible(const State& state) const {
  constexpr double least_cosine = -0.984807753;  // of 170 degrees
  return ends_.counts() ||
         ends_.ball(ends_.gathered(state.q), Ends::Vector::Zero(), 0, 0).cosine > least_cosine;
}

template class RotationalSpring<2>;
template class RotationalSpring<3>;

}  // namespace nurbeam
