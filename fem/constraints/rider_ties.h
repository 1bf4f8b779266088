#pragma once
#include "fem/constraints/axes_on_section.h"
#include "fem/constraints/body_on_guide.h"
#include "fem/constraints/body_on_node.h"
#include "fem/constraints/body_on_point.h"
#include "fem/constraints/body_on_section.h"
#include "fem/constraints/held_place.h"
#include "fem/constraints/passed_roll.h"
#include "fem/constraints/sleeve.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// Binds the body of a rider to its place: one constraint, or none where the body has no coordinates of its
/// own.
template <int D, class Add>
void bind_body(int j, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  if (at.structure.beam_of(at.structure.riders[j]).rigid) return add(BodyOnGuide<D>(at, j));
  const bool is_node = at.mesh.plan.modes[j] == Carried::node;
  if constexpr (D == 3) {
    if (at.structure.riders[j].is_offset()) {
      if (is_node) return add(BodyOnSection<FollowedNode>(at, drawn, j));
      return add(BodyOnSection<FollowedPoint>(at, drawn, j));
    }
  }
  if (!is_node) return add(BodyOnPoint<D>(at, drawn, j));
  if (at.structure.riders[j].stands_apart()) add(BodyOnNode<D>(at, j));
}

/// Binds the attitude of a rigid body to the section where its rider is.
template <class Section, class Add>
void bind_axes(int j, const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, Add&& add) {
  if (at.structure.riders[j].follows == Follows::section) return add(AxesOnSection<Section, 3>(at, drawn, j));
  add(AxesOnSection<Section, 2>(at, drawn, j));
}
template <class Add>
void bind_attitude(int j, const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, Add&& add) {
  const Rider& rider = at.structure.riders[j];
  if (rider.follows == Follows::nothing) return;
  if (at.structure.beam_of(rider).rigid) return bind_axes<GuideSection>(j, at, drawn, add);
  if (at.mesh.plan.modes[j] == Carried::node) return bind_axes<FollowedNode>(j, at, drawn, add);
  bind_axes<FollowedPoint>(j, at, drawn, add);
}

/// Constraints of the riders, as the mesh carries them.
template <int D>
struct RiderTies {
  /// Ties last less long than other constraints: they move over the mesh.
  static constexpr bool moves = true;

  template <class Add>
  static void bind(Binding<D>& binding, Add&& add) {
    for (int j = 0; j < static_cast<int>(binding.at.structure.riders.size()); ++j) {
      binding.ties.push_back(binding.rows);
      if (binding.at.mesh.plan.modes[j] != Carried::free) bind_joint(j, binding, add);
    }
  }

 private:
  template <class Add>
  static void bind_joint(int j, const Binding<D>& binding, Add&& add) {
    const MeshedBeams<D>& at = binding.at;
    const Carried mode = at.mesh.plan.modes[j];
    bind_body<D>(j, at, binding.drawn, add);
    const Rider& rider = at.structure.riders[j];
    if constexpr (D == 3)
      if (mode == Carried::node && !rider.continuous_slope && at.structure.beam_of(rider).has_torsion())
        add(PassedRoll(at, j));
    if constexpr (D == 3) bind_attitude(j, at, binding.drawn, add);
    if (rider.direction && mode == Carried::node) add(HeldSlope<D>(at, j));
    const int place = at.mesh.riders[j].place;
    if (mode == Carried::stopped || binding.holds(j) || at.mesh.plan.holds(j))
      add(HeldPlace<D>(place, at.mesh.plan.places[j]));
    else if (rider.motion)
      add(HeldPlace<D>(place, *rider.motion));
  }
};

}  // namespace nurbeam
