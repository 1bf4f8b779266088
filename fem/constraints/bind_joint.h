#pragma once
#include "fem/constraints/body_on_guide.h"
#include "fem/constraints/body_on_node.h"
#include "fem/constraints/body_on_point.h"
#include "fem/constraints/body_on_section.h"
#include "fem/constraints/held_place.h"
#include "fem/constraints/passed_roll.h"

namespace nurbeam {

/// Where the body of a sliding joint is: one constraint, or none where it has no coordinates of its own.
template <int D, class Add>
void bind_body(int j, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  if (at.structure.beam_of(at.structure.joints[j]).rigid) return add(BodyOnGuide<D>(at, j));
  const bool is_node = at.mesh.plan.modes[j] == JointMode::node;
  if constexpr (D == 3) {
    if (at.structure.joints[j].is_offset()) {
      if (is_node) return add(BodyOnSection<FollowedNode>(at, drawn, j));
      return add(BodyOnSection<FollowedPoint>(at, drawn, j));
    }
  }
  if (!is_node) return add(BodyOnPoint<D>(at, drawn, j));
  if (at.structure.joints[j].stands_apart()) add(BodyOnNode<D>(at, j));
}

/// What a sliding joint asks for as it is carried in this mesh. `held`: its place is held where the plan has
/// it.
template <int D, class Add>
void bind_joint(int j, bool held, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  const JointMode mode = at.mesh.plan.modes[j];
  if (mode == JointMode::free) return;
  bind_body<D>(j, at, drawn, add);
  const SlidingJoint& joint = at.structure.joints[j];
  if constexpr (D == 3)
    if (mode == JointMode::node && !joint.continuous_slope && at.structure.beam_of(joint).has_torsion())
      add(PassedRoll(at, j));
  const int place = at.mesh.joints[j].place;
  if (mode == JointMode::stopped || held || at.mesh.plan.holds(j))
    add(HeldPlace<D>(place, at.mesh.plan.places[j]));
  else if (joint.motion)
    add(HeldPlace<D>(place, *joint.motion));
}

}  // namespace nurbeam
