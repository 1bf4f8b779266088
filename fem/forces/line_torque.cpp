#include "fem/forces/line_torque.h"

namespace nurbeam {

TwistLayout::Coordinates LineTorque::on_element(const MeshElement<3>& e, const State& state) const {
  return per_length(state) * e.twist->element.torque_force(gather_twist(e, state.q));
}

TwistLayout::Matrix LineTorque::gradient(const MeshElement<3>& e, const State& state) const {
  return per_length(state) * e.twist->element.torque_gradient(gather_twist(e, state.q));
}

void LineTorque::add_force(const MeshedBeams<3>& at, const State& state,
                           Eigen::Ref<Eigen::VectorXd> dynamics) const {
  for (int i = at.mesh.first_span[beam]; i < at.mesh.first_span[beam + 1]; ++i) {
    const MeshElement<3>& e = at.elements[i];
    const TwistLayout::Coordinates f = on_element(e, state);
    for (int k = 0; k < TwistLayout::size; ++k)
      if (e.twist->dofs[k] >= 0) dynamics[e.twist->dofs[k]] -= f[k];
  }
}

double LineTorque::work(const MeshedBeams<3>& at, const State& from, const State& to) const {
  double power = 0;
  for (const State* state : {&from, &to})
    for (int i = at.mesh.first_span[beam]; i < at.mesh.first_span[beam + 1]; ++i) {
      const MeshElement<3>& e = at.elements[i];
      power += on_element(e, *state).dot(gather_twist(e, *state).v);
    }
  return (to.t - from.t) / 2 * power;
}

}  // namespace nurbeam
