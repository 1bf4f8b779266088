#pragma once
#include "fem/constraints/body_at_place.h"
#include "fem/constraints/body_on_body.h"
#include "fem/constraints/held_position_of_body.h"
#include "fem/constraints/point_on_body.h"
#include "fem/constraints/point_on_line.h"
#include "fem/constraints/square_axes.h"
#include "fem/constraints/turned.h"
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
  if (joint.to.is_point())
    return add(HeldPositionOfBody<3>(at, joint.point, joint.to.point, joint.motion, joint.turn));
  if (joint.to.beam >= 0) return add(BodyAtPlace(at, joint.point, joint.to));
  if (on_rigid) return add(PointOnBody(at, joint.point, {joint.to.body, joint.arm}));
  add(BodyOnBody<3>(at, CarriedBody{.body = joint.point, .carrier = joint.to.body}));
}

/// Binds N pairs of axes, with what turns them.
template <int N, class Add>
void bind_pairs(const BodyJoint& joint, const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, Add&& add) {
  const std::array<Grip, 2> ends{Grip::on_body(joint.turning_body(at.structure)), joint.to};
  SquareAxes<N> square(at, drawn, ends, joint.pairs);
  if constexpr (N > 1)
    if (joint.turn) return add(Turned<3, SquareAxes<N>>(std::move(square), *joint.turn));
  add(std::move(square));
}

/// Binds what holds the place of a body, and then its attitude.
template <int D, class Add>
void bind(const BodyJoint& joint, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, Add&& add) {
  if constexpr (D == 3) {
    bind_place(joint, at, add);
    if (joint.pairs.empty()) return;
    if (joint.pairs.size() == 1) return bind_pairs<1>(joint, at, drawn, add);
    if (joint.pairs.size() == 2) return bind_pairs<2>(joint, at, drawn, add);
    bind_pairs<3>(joint, at, drawn, add);
  }
}

}  // namespace nurbeam
