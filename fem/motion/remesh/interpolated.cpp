// A motion as a new mesh takes it over, before velocities are projected and energy is conserved.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "fem/element/section_frame.h"
#include "fem/mesh/drawn_coordinates.h"
#include "fem/motion/remesh/carried_sections.h"
#include "fem/motion/remesh/matched_node.h"
#include "fem/motion/remesh/transfer.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// Copies coordinates and their rates from another mesh. Coordinates that follow one another in both meshes
// are copied at once.
class KeptCoordinates {
 public:
  KeptCoordinates(const State& from, State& to) : from_(from), to_(to) {}
  ~KeptCoordinates() { copy(); }
  KeptCoordinates(const KeptCoordinates&) = delete;
  KeptCoordinates& operator=(const KeptCoordinates&) = delete;

  void take(int target, int source, int count) {
    if (target != target_ + count_ || source != source_ + count_) {
      copy();
      target_ = target;
      source_ = source;
      count_ = 0;
    }
    count_ += count;
  }
  // Takes position, slopes, sections and place of a node.
  void take(const MeshNode& node, const MeshNode& kept, int D) {
    take(node.r, kept.r, D);
    take(node.slope_left, kept.slope_left, D);
    if (node.slope_right != node.slope_left || kept.slope_right != kept.slope_left)
      take(node.slope_right, kept.slope_right, D);
    if (node.angle_left >= 0) {
      take(node.angle_left, kept.angle_left, 1);
      take(node.angle_right, kept.angle_right, 1);
    }
    if (node.place >= 0) take(node.place, kept.place, 1);
  }

 private:
  void copy() {
    to_.q.segment(target_, count_) = from_.q.segment(source_, count_);
    to_.v.segment(target_, count_) = from_.v.segment(source_, count_);
    to_.a.segment(target_, count_) = from_.a.segment(source_, count_);
  }

  const State& from_;
  State& to_;
  int target_ = 0, source_ = 0, count_ = 0;  // coordinates not yet copied
};

// A node on the curve of another mesh, at rest or moving over it.
struct NodeOnCurve {
  double s, rate;  // place [m] and its rate [m/s]
  MaterialPoint<3> point;

  NodeOnCurve(const BeamSystem& from, const State& state, int beam, const MeshNode& node)
      : s(node.rider >= 0 ? state.q[from.mesh().riders[node.rider].place] : node.s),
        rate(node.rider >= 0 ? place_rate(from, state, node.rider) : 0),
        point(material_point(from, state, beam, s)) {}

  Eigen::Vector3d velocity() const { return point.velocity + rate * point.rs; }
  Eigen::Vector3d slope_rate() const { return point.velocity_s + rate * point.rss; }
};

// The motion a moment before and a moment after a state.
struct Around {
  State before, after;
  double length = 1;  // time between them [s]

  Around(const BeamSystem& system, const State& state) : before(state), after(state) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const MeshSpan& span : system.mesh().spans)
      shortest = std::min(shortest, span.end(state.q) - span.start(state.q));
    constexpr double far = 1e-3;  // moved part of the shortest span between the two moments
    const double rate = state.v.lpNorm<Eigen::Infinity>() / shortest +
                        std::sqrt(state.a.lpNorm<Eigen::Infinity>() / shortest);
    if (rate > 0) length = std::min(far / rate, 1.0);
    go_on(before, -length / 2);
    go_on(after, length / 2);
  }

 private:
  static void go_on(State& state, double time) {
    state.q += time * state.v + time * time / 2 * state.a;
    state.v += time * state.a;
  }
};

// Places a new node on the curve of the old mesh. `i`: index among the nodes of the beam in the new mesh.
void place_node(const BeamSystem& from, const State& state, const Around& around, const BeamSystem& to,
                int beam, int i, State& next) {
  const int D = from.dimension();
  const MeshNode& node = to.mesh().nodes[beam][i];
  const NodeOnCurve now(from, state, beam, node), before(from, around.before, beam, node),
      after(from, around.after, beam, node);
  next.q.segment(node.r, D) = now.point.r.head(D);
  next.v.segment(node.r, D) = now.velocity().head(D);
  next.a.segment(node.r, D) = (after.velocity() - before.velocity()).head(D) / around.length;
  for (int slope : {node.slope_left, node.slope_right}) {
    next.q.segment(slope, D) = now.point.rs.head(D);
    next.v.segment(slope, D) = now.slope_rate().head(D);
    next.a.segment(slope, D) = (after.slope_rate() - before.slope_rate()).head(D) / around.length;
  }
  // The rate of the node's angle is the spin of the material, plus the twist as the node moves over it.
  if (node.angle_left >= 0) {
    const Eigen::Matrix3d section = section_point(from, state, beam, now.s).triad.matrix();
    const double spin =
        material_spin(from, state, beam, now.s) + now.rate * section_twist(from, state, beam, now.s);
    for (const int end : {0, 1}) {
      const Eigen::Matrix3d& chart = section_chart(to, beam, i, end);
      const int angle = end == 0 ? node.angle_right : node.angle_left;
      next.q[angle] = angle_in(chart, section);
      next.v[angle] = spin - spin_row<double>(chart, now.point.rs).dot(now.slope_rate());
    }
  }
  if (node.place < 0) return;
  next.q[node.place] = now.s;
  next.v[node.place] = now.rate;
}

// Takes the nodes that both meshes have, and returns the new ones: beams and indices.
std::vector<std::pair<int, int>> take_nodes(const State& state, const Mesh& old, const Mesh& mesh,
                                            State& next) {
  const int D = mesh.dimension;
  std::vector<std::pair<int, int>> added;
  KeptCoordinates kept(state, next);
  for (int b = 0; b < static_cast<int>(mesh.nodes.size()); ++b)
    for (int i = 0, same = -1; i < static_cast<int>(mesh.nodes[b].size()); ++i) {
      const MeshNode& node = mesh.nodes[b][i];
      same = same_node(old.nodes[b], node, same + 1);
      if (same >= 0)
        kept.take(node, old.nodes[b][same], D);
      else
        added.emplace_back(b, i);
    }
  return added;
}

void take_bodies(const State& state, const Mesh& old, const Mesh& mesh, State& next) {
  const int D = mesh.dimension;
  KeptCoordinates kept(state, next);
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body) {
    kept.take(mesh.bodies[body], old.bodies[body], D);
    if (mesh.attitudes[body] >= 0) kept.take(mesh.attitudes[body], old.attitudes[body], 4);
  }
  for (std::size_t j = 0; j < mesh.riders.size(); ++j)
    if (mesh.riders[j].place >= 0 && old.riders[j].place >= 0)
      kept.take(mesh.riders[j].place, old.riders[j].place, 1);
}

// Sets the bubbles of twist: kept for elements that the old mesh has too, else from the twist of the old
// mesh.
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
  const Mesh &old = from.mesh(), &mesh = to.mesh();
  const std::vector<std::pair<int, int>> added = take_nodes(state, old, mesh, next);
  if (!added.empty()) {
    const Around around(from, state);
    for (const auto& [beam, node] : added) place_node(from, state, around, to, beam, node, next);
  }
  take_bodies(state, old, mesh, next);
  set_bubbles(from, state, to, next);
  for (const auto& [beam, node] : added) match_axial_strain(from, state, to, beam, node, next);
  carry_bodies(to, next);
  return next;
}

}  // namespace nurbeam
