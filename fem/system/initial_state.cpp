#include "fem/system/initial_state.h"

#include "fem/mesh/drawn_coordinates.h"
#include "fem/system/assembly.h"
#include "fem/system/material_points.h"

namespace nurbeam {

namespace {

// The rates of the angles of a moving node, and of the bubbles beside it, over sections at rest. The slopes
// have theirs.
void slide_sections(const BeamSystem& system, const MeshNode& node, int left, int right, double speed,
                    State& state) {
  const auto& elements = system.assembly<3>()->elements();
  const auto angle_rate = [&](const MeshElement<3>& e, int end) {
    const TwistElement& element = e.twist->element;
    const TwistState x = gather_twist(e, state);
    const double s = x.q[TwistLayout::place(end)];
    const double twist = e.element.curve().section(s, end == 1).twist + element.section(x.q, s).strain.twist;
    return speed * twist - (element.spin(x, end) - x.v[TwistLayout::angle(end)]);
  };
  const double before = angle_rate(elements[left], 1), after = angle_rate(elements[right], 0);
  const bool shared = node.angle_left == node.angle_right;
  state.v[node.angle_left] = shared ? (before + after) / 2 : before;
  if (!shared) state.v[node.angle_right] = after;
  for (const int i : {left, right}) {
    const MeshSpan& span = system.mesh().spans[i];
    const double rate = (i == left ? 1 : -1) * speed / (span.end(state.q) - span.start(state.q));
    state.v[span.bubble] += 2 * state.q[span.bubble] * rate;
  }
}

}  // namespace

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
    if (node.angle_left >= 0)
      slide_sections(system, node, (index > first ? index : end) - 1, index, speed, state);
  }
}

}  // namespace nurbeam
