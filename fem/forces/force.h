#pragma once
#include <type_traits>
#include <variant>

#include "fem/forces/custom_force.h"
#include "fem/forces/line_load.h"
#include "fem/forces/moment.h"
#include "fem/forces/point_load.h"
#include "fem/forces/point_mass.h"

/// The lists of forces: all that has to be said of a new one outside its own file.
///
/// A force in a mesh may offer: add_force(at, state, dynamics) (dynamics is inertia less forces) with
/// add_tangent(at, state, weights, sink), which hands matrices to sink.element(index, K) or, in its own
/// dofs(), to sink.own(K); per_length(beam, t), which the elements carry; add_energy(at, state, sum);
/// momentum(state); work(at, from, to), but for weight, between two states on one mesh [J]; add_actions(at,
/// state, actions), what it does to points of beams. State::load scales all forces. A description that is not
/// itself such a force needs bind_force.
namespace nurbeam {

using Force = std::variant<PointLoad, Moment, LineLoad, CustomForce>;

template <int D>
using BoundForce = std::variant<PointMass<D>, PointLoad, Moment, LineLoad, BoundCustomForce<D>>;

template <int D, class Description>
BoundForce<D> bind_force(const Description& force, const MeshedBeams<D>&, const Eigen::VectorXd&) {
  return force;
}
template <int D>
BoundForce<D> bind_force(const CustomForce& force, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn) {
  return BoundCustomForce<D>(force, at, drawn);
}

}  // namespace nurbeam
