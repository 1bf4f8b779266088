#pragma once
#include <type_traits>
#include <variant>

#include "fem/constraints/bind_joint.h"
#include "fem/constraints/corner_angle.h"
#include "fem/constraints/joined_points.h"
#include "fem/constraints/joined_slopes.h"
#include "fem/constraints/kept_contact.h"
#include "fem/constraints/kept_length.h"
#include "fem/constraints/support.h"

/// The lists of constraints: all that has to be said of a new one outside its own file.
///
/// A description (Constraint: Support, ...) offers bind<D>(description, at, drawn, add), which adds the
/// constraints that it means in a mesh. Such a constraint offers `rows` (at most D), dofs() (global
/// coordinates, -1 for none, at most those of two elements), terms(at, state, y): ConstraintTerms<D> with the
/// Hessian contracted with y where that is not null, and, if it has them, rate(t) and acceleration(t) (dg/dt,
/// d2g/dt2 at fixed q), `linear` (no Hessian) and force(y) on the beam where that is not -y.
namespace nurbeam {

/// In either dimension, and `Others` besides.
template <int D, class... Others>
using ConstraintList =
    std::variant<HeldPosition<D>, GuidedPlace<D>, HeldDirection<D>, HeldPlace<D>, BodyOnPoint<D>,
                 BodyOnGuide<D>, BodyOnNode<D>, KeptContact<D>, JoinedPoints<D>, JoinedSlopes<D>,
                 CornerAngle<D>, KeptLength<D>, Others...>;
template <int D>
using BoundConstraint =
    std::conditional_t<D == 3,
                       ConstraintList<D, ClampedRoll, ForkedRoll, JoinedSections, HeldAxis, PassedRoll,
                                      BodyOnSection<FollowedNode>, BodyOnSection<FollowedPoint>>,
                       ConstraintList<D>>;

}  // namespace nurbeam
