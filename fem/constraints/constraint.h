#pragma once
#include <type_traits>
#include <variant>

#include "fem/constraints/corner_angle.h"
#include "fem/constraints/held_position_of_body.h"
#include "fem/constraints/joined_points.h"
#include "fem/constraints/joined_slopes.h"
#include "fem/constraints/kept_contact.h"
#include "fem/constraints/kept_length.h"
#include "fem/constraints/rider_ties.h"
#include "fem/constraints/support.h"
#include "fem/structure/type_list.h"

/// The lists of constraints: all that has to be said of a new one outside its own file.
///
/// A description (Constraint: Support, ...) offers bind<D>(description, at, drawn, add), which adds the
/// constraints that it means in a mesh. A constraint in a mesh offers `rows` (at most D), dofs() (global
/// coordinates, -1 for none, at most those of two elements), terms(at, state, y): ConstraintTerms<D> with the
/// Hessian contracted with y where that is not null, and, if it has them, rate(t) and acceleration(t) (dg/dt,
/// d2g/dt2 at fixed q), `linear` (no Hessian), and of its multipliers y force(y) on the beam where that is
/// not -y, couple(at, state, y), action(at, state, y) on a point of a beam, on_body(body, state, y), what it
/// gives to a body [N], and work(from, to, y_from, y_to), done between two states on one mesh [J]; body(),
/// first coordinate of a body that follows what the other coordinates do; what it is for: the coordinate of a
/// place(), a closed_stop(), a connector() with its length_and_force(state, y).
namespace nurbeam {

/// In either dimension, and `Others` besides.
template <int D, class... Others>
using ConstraintList =
    std::variant<HeldPosition<D>, GuidedPlace<D>, HeldDirection<D>, HeldPlace<D>, BodyOnPoint<D>,
                 BodyOnGuide<D>, BodyOnNode<D>, KeptContact<D>, JoinedPoints<D>, JoinedSlopes<D>,
                 CornerAngle<D>, KeptLength<D>, HeldPositionOfBody<D>, Others...>;
template <int D>
using BoundConstraint =
    std::conditional_t<D == 3,
                       ConstraintList<D, ClampedRoll, ForkedRoll, JoinedSections, HeldAxis, PassedRoll,
                                      BodyOnSection<FollowedNode>, BodyOnSection<FollowedPoint>>,
                       ConstraintList<D>>;

/// What the parts of a structure ask for by themselves, in the order of the rows, after those of
/// descriptions: each offers bind(binding, add), and `moves` where its constraints do over the mesh. As
/// restart points know multipliers by their rows, a new one comes last.
template <int D>
using ConstraintSources = TypeList<RiderTies<D>, KeptContact<D>, CornerAngle<D>, KeptLength<D>>;

}  // namespace nurbeam
