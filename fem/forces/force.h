#pragma once
#include <type_traits>
#include <variant>

#include "fem/forces/custom_force.h"
#include "fem/forces/line_load.h"
#include "fem/forces/line_torque.h"
#include "fem/forces/moment.h"
#include "fem/forces/point_load.h"
#include "fem/forces/point_mass.h"
#include "fem/forces/roll_inertia.h"

/// The lists of forces: all that has to be said of a new one outside its own file.
///
/// A force in a mesh may offer: add_force(at, state, dynamics) (dynamics is inertia less forces) with
/// add_tangent(at, state, weights, sink), which hands matrices to sink.element(index, K) or, in its own
/// dofs(), to sink.own(K); per_length(beam, t), which the elements carry; add_energy(at, state, sum);
/// momentum(state); spin(at, state), of the roll of the body of a joint(), with add_momentum; work(at, from,
/// to), but for weight, between two states on one mesh [J]; add_actions(at,
/// state, actions), what it does to points of beams. State::load scales all forces. A description that is not
/// itself such a force needs bind_force.
namespace nurbeam {

using Force = std::variant<PointLoad, Moment, LineLoad, LineTorque, CustomForce>;

/// In either dimension, and `Others` besides.
template <int D, class... Others>
using ForceList =
    std::variant<PointMass<D>, PointLoad, Moment, LineLoad, LineTorque, BoundCustomForce<D>, Others...>;
template <int D>
using BoundForce =
    std::conditional_t<D == 3, ForceList<D, RollInertia<FollowedNode>, RollInertia<FollowedPoint>, FreeRoll>,
                       ForceList<D>>;

template <int D, class Description>
BoundForce<D> bind_force(const Description& force, const MeshedBeams<D>&, const Eigen::VectorXd&) {
  return force;
}
template <int D>
BoundForce<D> bind_force(const CustomForce& force, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn) {
  return BoundCustomForce<D>(force, at, drawn);
}

}  // namespace nurbeam
