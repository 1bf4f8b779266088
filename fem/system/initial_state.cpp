#include "fem/system/initial_state.h"

#include <Eigen/Geometry>

#include "fem/mesh/attitude.h"
#include "fem/mesh/drawn_coordinates.h"
#include "fem/system/assembly.h"
#include "fem/system/material_points.h"
#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

// The given velocity of a beam at a material point, and its derivative along the beam.
struct GivenVelocity {
  Eigen::Vector3d value = Eigen::Vector3d::Zero(), by_s = Eigen::Vector3d::Zero();

  GivenVelocity(const Beam& beam, const MaterialPoint<3>& p) {
    if (beam.velocity) add(*beam.velocity, p);
    value += beam.flow * p.rs;
    by_s += beam.flow * p.rss;
  }
  static bool is_of(const Beam& beam) { return beam.velocity || beam.flow != 0; }

 private:
  void add(const BeamVelocity& given, const MaterialPoint<3>& p) {
    const double stretch = p.rs.norm();
    const Eigen::Vector3d t = p.rs / stretch;
    value = given.translation + given.rotation.cross(p.r - given.about) + given.along * t;
    by_s = given.rotation.cross(p.rs) + given.along / stretch * (p.rss - t * t.dot(p.rss));
  }
};

// Sums for the coordinates of a mesh; coordinates with several contributions get their mean.
class NodalMeans {
 public:
  explicit NodalMeans(int coordinates)
      : sum_(Eigen::VectorXd::Zero(coordinates)), count_(Eigen::VectorXd::Zero(coordinates)) {}

  void add(int first, int size, const Eigen::Vector3d& value) {
    sum_.segment(first, size) += value.head(size);
    count_.segment(first, size).array() += 1;
  }
  Eigen::VectorXd means() const { return sum_.cwiseQuotient(count_.cwiseMax(1)); }

 private:
  Eigen::VectorXd sum_, count_;
};

// Given velocities of the nodes and of the bodies that are carried as points.
Eigen::VectorXd given_velocities(const BeamSystem& system, const State& state) {
  const BeamModel& model = system.model();
  const Mesh& mesh = system.mesh();
  const int D = system.dimension();
  NodalMeans v(system.coordinate_count());
  for (int i = 0; i < static_cast<int>(mesh.spans.size()); ++i) {
    const MeshSpan& span = mesh.spans[i];
    const Beam& beam = model.beams[span.beam];
    if (!GivenVelocity::is_of(beam)) continue;
    for (const int end : {0, 1}) {
      const MeshNode& node = end == 0 ? mesh.node_a(span) : mesh.node_b(span);
      const double s = end == 0 ? span.start(state.q) : span.end(state.q);
      const GivenVelocity velocity(beam, material_point_in(system, state, i, s));
      v.add(node.r, D, velocity.value);
      v.add(end == 0 ? node.slope_right : node.slope_left, D, velocity.by_s);
    }
  }
  for (std::size_t j = 0; j < mesh.riders.size(); ++j) {
    const Rider& rider = model.riders[j];
    if (!GivenVelocity::is_of(model.beam_of(rider)) || mesh.riders[j].node >= 0 || mesh.riders[j].place < 0)
      continue;
    const double s = state.q[mesh.riders[j].place];
    v.add(mesh.bodies[rider.body], D,
          GivenVelocity(model.beam_of(rider), material_point(system, state, rider.beam, s)).value);
  }
  return v.means();
}

// Adds to the rates of the sections' angles the turns by the given velocities, which `added` has.
void add_given_spins(const BeamSystem& system, const State& added, Eigen::VectorXd& v) {
  const Assembly<3>* assembly = system.assembly<3>();
  if (!assembly) return;
  NodalMeans rates(system.coordinate_count());
  for (const MeshElement<3>& e : assembly->elements()) {
    const std::optional<BeamVelocity>& given = system.model().beams[e.span->beam].velocity;
    if (!given || !e.twist) continue;
    for (const int end : {0, 1}) {
      const TwistState x = gather_twist(e, added);
      const Eigen::Vector3d t = x.q.segment<3>(TwistLayout::slope(end)).normalized();
      const double drawn = e.element.curve().section(x.q[TwistLayout::place(end)], end == 1).twist;
      const double spin = given->rotation.dot(t) + given->along * drawn;
      rates.add(e.twist->dofs[TwistLayout::angle(end)], 1,
                Eigen::Vector3d::Constant(spin - e.twist->element.spin(x, end)));
    }
  }
  v += rates.means();
}

// Sets the rates of the angles of a moving node, and of the bubbles beside it, as it moves over sections at
// rest. The rates of slopes are set already.
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

// The field at a place, from the side ahead of a body that moves there at this speed along the beam.
MaterialPoint<3> point_ahead(const BeamSystem& system, const State& state, int beam, double s, double speed) {
  const Mesh& mesh = system.mesh();
  const int first = mesh.first_span[beam], end = mesh.first_span[beam + 1];
  if (!(speed < 0) || first == end) return material_point(system, state, beam, s);
  const int span = find_span(system.model(), mesh, state.q, beam, s);
  if (s > mesh.spans[span].start(state.q)) return material_point_in(system, state, span, s);
  if (span > first) return material_point_in(system, state, span - 1, s);
  return system.model().beams[beam].is_ring() ? material_point_in(system, state, end - 1, s)
                                              : material_point(system, state, beam, s);
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
  for (std::size_t body = 0; body < model.bodies.size(); ++body)
    if (const int p = mesh.attitudes[body]; p >= 0)
      state.v.segment<4>(p) = attitude::rate(state.q.segment<4>(p), model.bodies[body].rigid->spin);
  for (std::size_t j = 0; j < mesh.riders.size(); ++j) {
    const MeshRider& at = mesh.riders[j];
    if (mesh.plan.modes[j] == Carried::free) continue;
    const Rider& rider = model.riders[j];
    const double speed = rider.motion ? rider.motion->at(state.t).speed : rider.speed;
    const double s = state.q[at.place];
    const auto set_velocity = [&](const Eigen::Vector3d& rs) {
      state.v.segment(mesh.bodies[rider.body], D) = speed * rs.head(D);
      if (at.node >= 0) state.v.segment(mesh.nodes[rider.beam][at.node].r, D) = speed * rs.head(D);
    };
    set_velocity(point_ahead(system, state, rider.beam, s, speed).rs);
    state.v[at.place] = speed;
    if (at.node < 0) continue;
    const auto [before, behind] = spans_at(mesh, rider.beam, at.node);
    const MaterialPoint<3> right = material_point_in(system, state, behind, s);
    // The material is at rest, so the slopes at the moving node change only as the node moves along the
    // curve.
    const MaterialPoint<3> left = material_point_in(system, state, before, s);
    const MeshNode& node = mesh.nodes[rider.beam][at.node];
    // Where the beam runs through a kink in shape, its node stands still: given_velocities has the mean too.
    if (model.beam_of(rider).flow != 0) set_velocity((left.rs + right.rs) / 2);
    const bool shared = node.slope_left == node.slope_right;
    state.v.segment(node.slope_left, D) =
        speed * (shared ? Eigen::Vector3d((left.rss + right.rss) / 2) : left.rss).head(D);
    if (!shared) state.v.segment(node.slope_right, D) = speed * right.rss.head(D);
    if (node.angle_left >= 0) slide_sections(system, node, before, behind, speed, state);
  }
  State given = state;
  given.v = given_velocities(system, state);
  state.v += given.v;
  add_given_spins(system, given, state.v);
  carry_bodies(system, state);
}

void carry_bodies(const BeamSystem& system, State& state) {
  with_assembly(
      system, [&](const auto& assembly) { assembly.carry_bodies(state); });
}

}  // namespace nurbeam
