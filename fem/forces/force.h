#pragma once
#include <type_traits>
#include <variant>

#include "fem/forces/body_drag.h"
#include "fem/forces/body_load.h"
#include "fem/forces/buffer_force.h"
#include "fem/forces/custom_force.h"
#include "fem/forces/field_force.h"
#include "fem/forces/flow_force.h"
#include "fem/forces/line_load.h"
#include "fem/forces/line_torque.h"
#include "fem/forces/moment.h"
#include "fem/forces/place_drive.h"
#include "fem/forces/place_mass.h"
#include "fem/forces/point_load.h"
#include "fem/forces/point_mass.h"
#include "fem/forces/rigid_inertia.h"
#include "fem/forces/roll_inertia.h"
#include "fem/forces/rotational_spring.h"
#include "fem/forces/sliding_friction.h"
#include "fem/forces/spring.h"
#include "fem/forces/stored_rope.h"
#include "fem/structure/type_list.h"

/// The lists of forces: a new force needs a change here and nowhere else outside its own file.
///
/// A force in a mesh declares in `offers` (force_offers.h) which hooks it has; the assertions below check
/// that. State::load scales all loads. A description may be `permanent`: it belongs to the state that
/// buckling is about, and not to the loads that buckling multiplies. A description that is not itself a force
/// in a mesh names its Bound<D>, which is made of (description, at, drawn). It may ask for nodes with
/// for_each_node(visit).
namespace nurbeam {

using Force = std::variant<PointLoad, Moment, LineLoad, LineTorque, PlaceMass, CustomForce, BodyLoad>;

/// The kinds of forces in either dimension, and `Others` besides.
template <int D, class... Others>
using ForceList = std::variant<PointMass<D>, BoundPlaceMass<D>, Spring<D>, BodyDrag<D>, BufferForce<D>,
                               SlidingFriction<D>, PlaceDrive<D>, StoredRope<D>, FieldOnBeams<D>,
                               FieldOnBody<D>, FlowForce<D>, PointLoad, Moment, LineLoad, LineTorque,
                               BoundCustomForce<D>, RotationalSpring<D>, BoundBodyLoad<D>, Others...>;
template <int D>
using BoundForce = std::conditional_t<
    D == 3, ForceList<D, RollInertia<FollowedNode>, RollInertia<FollowedPoint>, FreeRoll, RigidInertia>,
    ForceList<D>>;

template <int D, class... F>
consteval bool all_keep_offers(const std::variant<F...>*) {
  return (keeps_offers<F, D>() && ...);
}
static_assert(all_keep_offers<2>(static_cast<BoundForce<2>*>(nullptr)),
              "a force offers what it has not, or the reverse");
static_assert(all_keep_offers<3>(static_cast<BoundForce<3>*>(nullptr)),
              "a force offers what it has not, or the reverse");

/// Sources of forces: the parts of a structure that bring forces by themselves, in the order in which these
/// are added up, before those of descriptions. Each source offers bind(binding, add).
template <int D>
using ForceSources = TypeList<PointMass<D>, BodyDrag<D>, BodyRolls<D>, SlidingFriction<D>, BufferForce<D>,
                              Spring<D>, PlaceDrive<D>, StoredRope<D>, FieldOnBeams<D>, FieldOnBody<D>,
                              FlowForce<D>, RigidInertia, RotationalSpring<D>>;

/// A description in a mesh: itself, or its Bound<D>.
template <int D, class Description>
BoundForce<D> bind_force(const Description& force, const Binding<D>& binding) {
  if constexpr (requires { typename Description::template Bound<D>; })
    return typename Description::template Bound<D>(force, binding.at, binding.drawn);
  else
    return force;
}

}  // namespace nurbeam
