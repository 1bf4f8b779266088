#pragma once
#include <type_traits>
#include <variant>

#include "fem/forces/body_drag.h"
#include "fem/forces/buffer_force.h"
#include "fem/forces/custom_force.h"
#include "fem/forces/line_load.h"
#include "fem/forces/line_torque.h"
#include "fem/forces/moment.h"
#include "fem/forces/place_mass.h"
#include "fem/forces/point_load.h"
#include "fem/forces/point_mass.h"
#include "fem/forces/roll_inertia.h"
#include "fem/forces/sliding_friction.h"
#include "fem/forces/spring.h"
#include "fem/structure/type_list.h"

/// The lists of forces: all that has to be said of a new one outside its own file.
///
/// A force in a mesh may offer: add_force(at, state, dynamics) (dynamics is inertia less forces) with
/// add_tangent(at, state, weights, sink), which hands matrices to sink.element(index, K) or, in its own
/// dofs(), to sink.own(K); per_length(beam, t), which the elements carry; add_energy(at, state, sum);
/// momentum(state); add_momentum_of(velocity, p), where it is at a place s() of a beam(); spin(at, state), of
/// the roll of the body of a rider(), with add_momentum; work(at, from, to), but for weight, between two
/// states on one mesh [J]; loss(at, from, to), of energy between them [J], where it is no rate in add_energy;
/// commit(at, state, memory), its part of State::memory after a step; add_actions(at, state, actions), what
/// it does to points of beams; on_body(at, body, state), what it gives to a body [N]; on_element(e, state),
/// the generalised force on an element of its `beam` with torsion, with per_length(state) about the tangent;
/// `depends_on_multipliers`; `has_constant_inertia`, where it is the same in all states and nothing of it
/// changes with velocities; `is_body`, where it is no more than a body's inertia and weight; is_damper(at),
/// whether it ends transients; what it is of: a sliding_joint() with its friction(at, state), a connector()
/// with its length_and_force(at, state). State::load scales all loads. A description may be `permanent`: part
/// of the state that buckling is about, not of the loads that it multiplies. One that is not itself such a
/// force names its Bound<D>, made of (description, at, drawn); it may ask for nodes with
/// for_each_node(visit).
namespace nurbeam {

using Force = std::variant<PointLoad, Moment, LineLoad, LineTorque, PlaceMass, CustomForce>;

/// In either dimension, and `Others` besides.
template <int D, class... Others>
using ForceList =
    std::variant<PointMass<D>, BoundPlaceMass<D>, Spring<D>, BodyDrag<D>, BufferForce<D>, SlidingFriction<D>,
                 PointLoad, Moment, LineLoad, LineTorque, BoundCustomForce<D>, Others...>;
template <int D>
using BoundForce =
    std::conditional_t<D == 3, ForceList<D, RollInertia<FollowedNode>, RollInertia<FollowedPoint>, FreeRoll>,
                       ForceList<D>>;

/// What the parts of a structure bring by themselves, in the order in which forces are added up, before those
/// of descriptions: each offers bind(binding, add).
template <int D>
using ForceSources =
    TypeList<PointMass<D>, BodyDrag<D>, BodyRolls<D>, SlidingFriction<D>, BufferForce<D>, Spring<D>>;

/// A description in a mesh: itself, or its Bound<D>.
template <int D, class Description>
BoundForce<D> bind_force(const Description& force, const Binding<D>& binding) {
  if constexpr (requires { typename Description::template Bound<D>; })
    return typename Description::template Bound<D>(force, binding.at, binding.drawn);
  else
    return force;
}

}  // namespace nurbeam
