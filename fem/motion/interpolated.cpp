// A motion as a new mesh takes it over, before velocities are projected and energy is kept.
#include <algorithm>
#include <utility>
#include <vector>

#include "fem/element/section_frame.h"
#include "fem/mesh/drawn_coordinates.h"
#include "fem/motion/carried_sections.h"
#include "fem/motion/matched_node.h"
#include "fem/motion/transfer.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// Position, slopes, sections and place of a node that the old mesh had too.
void keep_node(const MeshNode& kept, const State& state, const MeshNode& node, int D, State& next) {
  const auto copy = [&](int target, int source, int n) {
    next.q.segment(target, n) = state.q.segment(source, n);
    next.v.segment(target, n) = state.v.segment(source, n);
    next.a.segment(target, n) = state.a.segment(source, n);
  };
  copy(node.r, kept.r, D);
  copy(node.slope_left, kept.slope_left, D);
  copy(node.slope_right, kept.slope_right, D);
  if (node.angle_left >= 0) {
    copy(node.angle_left, kept.angle_left, 1);
    copy(node.angle_right, kept.angle_right, 1);
  }
  if (node.place >= 0) copy(node.place, kept.place, 1);
}

// `i`: of the nodes of the beam in the new mesh.
void place_node(const BeamSystem& from, const State& state, const BeamSystem& to, int beam, int i,
                State& next) {
  const int D = from.dimension();
  const MeshNode& node = to.mesh().nodes[beam][i];
  const double s = node.joint >= 0 ? state.q[from.mesh().joints[node.joint].place] : node.s;
  const MaterialPoint<3> p = material_point(from, state, beam, s);
  const double rate = node.joint >= 0 ? place_rate(from, state, node.joint) : 0;
  next.q.segment(node.r, D) = p.r.head(D);
  next.v.segment(node.r, D) = (p.velocity + rate * p.rs).head(D);
  const Eigen::Vector3d slope_rate = p.velocity_s + rate * p.rss;
  for (int slope : {node.slope_left, node.slope_right}) {
    next.q.segment(slope, D) = p.rs.head(D);
    next.v.segment(slope, D) = slope_rate.head(D);
  }
  // What the node sees is the spin of the material and, as it moves over it, the twist.
  if (node.angle_left >= 0) {
    const Eigen::Matrix3d section = section_point(from, state, beam, s).triad.matrix();
    const double spin = material_spin(from, state, beam, s) + rate * section_twist(from, state, beam, s);
    for (const int end : {0, 1}) {
      const Eigen::Matrix3d& chart = section_chart(to, beam, i, end);
      const int angle = end == 0 ? node.angle_right : node.angle_left;
      next.q[angle] = angle_in(chart, section);
      next.v[angle] = spin - spin_row<double>(chart, p.rs).dot(slope_rate);
    }
  }
  if (node.place < 0) return;
  next.q[node.place] = s;
  next.v[node.place] = rate;
}

// The bubbles of twist: those of elements that the old mesh had too, or its twist.
void set_bubbles(const BeamSystem& from, const State& state, const BeamSystem& to, State& next) {
  const Mesh &old = from.mesh(), &mesh = to.mesh();
  for (const MeshSpan& span : mesh.spans) {
    if (span.bubble < 0) continue;
    const int a = same_node(old.nodes[span.beam], mesh.node_a(span)),
              b = same_node(old.nodes[span.beam], mesh.node_b(span));
    const auto kept = std::find_if(old.spans.begin(), old.spans.end(), [&](const MeshSpan& x) {
      return x.beam == span.beam && x.node_a == a && x.node_b == b;
    });
    if (kept != old.spans.end()) {
      next.q[span.bubble] = state.q[kept->bubble];
      next.v[span.bubble] = state.v[kept->bubble];
      continue;
    }
    const CarriedTwist carried = carried_twist(from, state, span, next);
    next.q[span.bubble] = carried.bubble;
    next.v[span.bubble] = carried.bubble_rate;
  }
}

}  // namespace

State interpolated(const BeamSystem& from, const State& state, const BeamSystem& to) {
  State next;
  next.t = state.t;
  next.memory = state.memory;
  next.q = planned_places(to.mesh());
  next.v = next.a = Eigen::VectorXd::Zero(to.coordinate_count());
  next.lambda = state.lambda;
  if (next.lambda.size() != to.constraint_count()) next.lambda.setZero(to.constraint_count());
  const int D = to.dimension();
  const Mesh &old = from.mesh(), &mesh = to.mesh();
  std::vector<std::pair<int, int>> added;  // beam, node
  for (int b = 0; b < static_cast<int>(mesh.nodes.size()); ++b)
    for (int i = 0; i < static_cast<int>(mesh.nodes[b].size()); ++i) {
      const MeshNode& node = mesh.nodes[b][i];
      const int kept = same_node(old.nodes[b], node);
      if (kept >= 0) {
        keep_node(old.nodes[b][kept], state, node, D, next);
      } else {
        place_node(from, state, to, b, i, next);
        added.emplace_back(b, i);
      }
    }
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body) {
    next.q.segment(mesh.bodies[body], D) = state.q.segment(old.bodies[body], D);
    next.v.segment(mesh.bodies[body], D) = state.v.segment(old.bodies[body], D);
    next.a.segment(mesh.bodies[body], D) = state.a.segment(old.bodies[body], D);
  }
  for (std::size_t j = 0; j < mesh.joints.size(); ++j) {
    if (mesh.joints[j].place < 0 || old.joints[j].place < 0) continue;
    next.q[mesh.joints[j].place] = state.q[old.joints[j].place];
    next.v[mesh.joints[j].place] = state.v[old.joints[j].place];
    next.a[mesh.joints[j].place] = state.a[old.joints[j].place];
  }
  set_bubbles(from, state, to, next);
  for (const auto& [beam, node] : added) match_axial_strain(from, state, to, beam, node, next);
  carry_bodies(to, next);
  return next;
}

}  // namespace nurbeam
