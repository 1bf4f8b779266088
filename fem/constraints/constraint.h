#pragma once
#include <type_traits>
#include <variant>

#include "fem/constraints/body_joint.h"
#include "fem/constraints/body_on_body.h"
#include "fem/constraints/corner_angle.h"
#include "fem/constraints/held_position_of_body.h"
#include "fem/constraints/joined_points.h"
#include "fem/constraints/joined_slopes.h"
#include "fem/constraints/kept_contact.h"
#include "fem/constraints/kept_length.h"
#include "fem/constraints/point_on_body.h"
#include "fem/constraints/rider_ties.h"
#include "fem/constraints/support.h"
#include "fem/constraints/unit_attitude.h"
#include "fem/structure/type_list.h"

/// The lists of constraints: a new constraint needs a change here and nowhere else outside its own file.
///
/// A description (Constraint: Support, ...) offers bind<D>(description, at, drawn, add), which adds its
/// constraints in a mesh. A constraint in a mesh has `rows` (at most D) and dofs(): global coordinates, -1
/// for none, at most as many as two elements have. Its terms(at, state, y) are ConstraintTerms<D>, with the
/// Hessian contracted with y where y is not null. It declares in `offers` (constraint_offers.h) which hooks
/// it has besides; the assertions below check that.
namespace nurbeam {

/// The kinds of constraints in either dimension, and `Others` besides.
template <int D, class... Others>
using ConstraintList =
    std::variant<HeldPosition<D>, GuidedPlace<D>, HeldDirection<D>, HeldPlace<D>, BodyOnPoint<D>,
                 BodyOnGuide<D>, BodyOnNode<D>, KeptContact<D>, JoinedPoints<D>, JoinedSlopes<D>,
                 CornerAngle<D>, KeptLength<D>, HeldPositionOfBody<D>, BodyOnBody<D>, HeldSlope<D>,
                 TurnedGuide<D>, Turned<D, ClampedDirection<D>>, Others...>;
template <int D>
using BoundConstraint = std::conditional_t<
    D == 3,
    ConstraintList<
        D, ClampedRoll, ForkedRoll, JoinedSections, HeldAxis, PassedRoll, Turned<3, ClampedSection>,
        Turned<3, TurnedFork>, Turned<3, TurnedHinge>, BodyOnSection<FollowedNode>,
        BodyOnSection<FollowedPoint>, UnitAttitude, PointOnBody, AxesOnSection<GuideSection, 2>,
        AxesOnSection<GuideSection, 3>, AxesOnSection<FollowedNode, 2>, AxesOnSection<FollowedNode, 3>,
        AxesOnSection<FollowedPoint, 2>, AxesOnSection<FollowedPoint, 3>, SquareAxes<1>, SquareAxes<2>,
        SquareAxes<3>, BodyAtPlace, PointOnLine, Turned<3, SquareAxes<2>>, Turned<3, SquareAxes<3>>>,
    ConstraintList<D>>;

template <int D, class... C>
consteval bool all_keep_constraint_offers(const std::variant<C...>*) {
  return (keeps_constraint_offers<C, D>() && ...);
}
static_assert(all_keep_constraint_offers<2>(static_cast<BoundConstraint<2>*>(nullptr)),
              "a constraint offers what it has not, or the reverse");
static_assert(all_keep_constraint_offers<3>(static_cast<BoundConstraint<3>*>(nullptr)),
              "a constraint offers what it has not, or the reverse");

/// Sources of constraints: the parts of a structure that bring constraints by themselves, in the order of the
/// rows, after those of descriptions. Each offers bind(binding, add), and `moves` where its constraints move
/// over the mesh. Restart points know multipliers by their rows, so a new source comes last.
template <int D>
using ConstraintSources =
    TypeList<RiderTies<D>, KeptContact<D>, CornerAngle<D>, KeptLength<D>, UnitAttitude, PointOnBody>;

}  // namespace nurbeam
