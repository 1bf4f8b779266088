#pragma once
#include "fem/constraints/body_at_place.h"
#include "fem/constraints/body_on_body.h"
#include "fem/constraints/held_position_of_body.h"
#include "fem/constraints/point_on_body.h"
#include "fem/constraints/point_on_line.h"
#include "fem/constraints/square_axes.h"
#include "fem/structure/body_joint.h"

namespace nurbeam {

/// Binds what holds the place of a body.
template <class Add>
void bind_place(const BodyJoint& joint, const MeshedBeams<3>& at, Add&& add) {
  const bool on_rigid = joint.to.body >= 0 && at.structure.bodies[joint.to.body].rigid;
  if (joint.slide) {
    const Eigen::Vector3d from = joint.to.is_point() ? joint.to.point : joint.arm;
    return add(PointOnLine(at, joint.point, on_rigid ? joint.to.body : -1, from, *joint.slide));
  }
  if (joint.to.is_point()) return add(HeldPositionOfBody<3>(at, joint.point, joint.to.point, joint.motion));
  if (joint.to.beam >= 0) return add(BodyAtPlace(at, joint.point, joint.to));
  if (on_rigid) return add(PointOnBody(at, joint.point, {joint.to.body, joint.arm}));
  add(BodyOnBody<3>(at, CarriedBody{.body = joint.point, .carrier = joint.to.body}));
}

/// Binds what holds the place of a body, and then its attitude.
template <int D, class Add>
void bind(const BodyJoint& joint, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  if constexpr (D == 3) {
    bind_place(joint, at, add);
    if (joint.pairs.empty()) return;
    const std::array<Grip, 2> ends{Grip::on_body(joint.turning_body(at.structure)), joint.to};
    if (joint.pairs.size() == 1) return add(SquareAxes<1>(at, drawn, ends, joint.pairs));
    if (joint.pairs.size() == 2) return add(SquareAxes<2>(at, drawn, ends, joint.pairs));
    add(SquareAxes<3>(at, drawn, ends, joint.pairs));
  }
}

}  // namespace nurbeam
