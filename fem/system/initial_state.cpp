#include "fem/system/initial_state.h"

#include "fem/mesh/drawn_coordinates.h"
#include "fem/system/material_points.h"

namespace nurbeam {

State drawn_state(const BeamSystem& system) {
  State state;
  state.q = drawn_coordinates(system.model(), system.mesh());
  state.v = state.a = Eigen::VectorXd::Zero(system.coordinate_count());
  state.lambda = Eigen::VectorXd::Zero(system.constraint_count());
  return state;
}

void start_moving(const BeamSystem& system, State& state) {
  const BeamModel& model = system.model();
  const Mesh& mesh = system.mesh();
  const int D = system.dimension();
  state.v.setZero();
  for (std::size_t body = 0; body < model.bodies.size(); ++body)
    state.v.segment(mesh.bodies[body], D) = model.bodies[body].velocity.head(D);
  for (std::size_t j = 0; j < mesh.joints.size(); ++j) {
    const MeshJoint& at = mesh.joints[j];
    if (mesh.plan.modes[j] == JointMode::free) continue;
    const SlidingJoint& joint = model.joints[j];
    const double speed = joint.motion ? value_and_slope(*joint.motion, state.t).second : joint.speed;
    const double s = state.q[at.place];
    const int first = mesh.first_span[joint.beam], end = mesh.first_span[joint.beam + 1];
    const int index = at.node >= 0 ? first + at.node : find_span(model, mesh, state.q, joint.beam, s);
    const MaterialPoint<3> right = material_point_in(system, state, index, s);
    state.v.segment(mesh.bodies[joint.body], D) = speed * right.rs.head(D);
    state.v[at.place] = speed;
    if (at.node < 0) continue;
    // The material is at rest, so the slopes at the moving node change by what the node meets.
    const MaterialPoint<3> left = material_point_in(system, state, (index > first ? index : end) - 1, s);
    const MeshNode& node = mesh.nodes[joint.beam][at.node];
    const bool shared = node.slope_left == node.slope_right;
    state.v.segment(node.slope_left, D) =
        speed * (shared ? Eigen::Vector3d((left.rss + right.rss) / 2) : left.rss).head(D);
    if (!shared) state.v.segment(node.slope_right, D) = speed * right.rss.head(D);
  }
}

}  // namespace nurbeam
