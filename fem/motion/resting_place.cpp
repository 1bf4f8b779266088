#include "fem/motion/resting_place.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "fem/motion/sliding_bodies.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "solver/static_equilibrium.h"

namespace nurbeam {

namespace {

// How far a joint can move in a direction while its elements keep a fifth of their length [m].
double room_to_move(const MeshedState& at, int joint, int direction) {
  const Mesh& mesh = at.system->mesh();
  const int node = mesh.joints[joint].node;
  if (node < 0) return std::numeric_limits<double>::infinity();
  const int beam = at.system->model().joints[joint].beam, first = mesh.first_span[beam];
  const int count = mesh.first_span[beam + 1] - first;
  const MeshSpan& span = mesh.spans[first + (direction > 0 ? node : (node + count - 1) % count)];
  return 0.8 * (span.end(at.state.q) - span.start(at.state.q));
}

void move_place(MeshedState& at, int joint, double ds) {
  const Mesh& mesh = at.system->mesh();
  const MeshJoint& moved = mesh.joints[joint];
  if (moved.place < 0 || ds == 0) return;
  State& state = at.state;
  const int D = mesh.dimension;
  const double s = state.q[moved.place] + ds;
  const SlidingJoint& sliding = at.system->model().joints[joint];
  const MaterialPoint<3> p = material_point(*at.system, state, sliding.beam, s);
  state.q.segment(mesh.bodies[sliding.body], D) = p.r.head(D);
  if (moved.node >= 0) {
    const MeshNode& node = mesh.nodes[sliding.beam][moved.node];
    for (int slope : {node.slope_left, node.slope_right}) state.q.segment(slope, D) = p.rs.head(D);
  }
  state.q[moved.place] = s;
  state.v[moved.place] = ds;  // length control looks at the direction
}

// The plan of the mesh with the joints where they have been moved.
MeshPlan moved_plan(const MeshedState& at) {
  MeshPlan plan = at.system->mesh().plan;
  for (std::size_t j = 0; j < plan.places.size(); ++j)
    if (const auto s = place(*at.system, at.state, static_cast<int>(j))) plan.places[j] = *s;
  return plan;
}

// A sliding body on its way to where it rests.
struct Descent {
  double move;          // the next one's length [m]; 0 when the body has arrived
  double force = 0;     // that held it before the last one [N]
  bool at_end = false;  // of the beam
};

// The next move of a body [m], down the slope: what holds it shows where it does not want to go.
double next_move(const MeshedState& at, int joint, Descent& body) {
  if (body.move == 0) return 0;
  const double now = holding_force(*at.system, at.state, joint);
  if (body.force * now < 0) body.move /= 2;
  body.force = now;
  const ReferenceCurve& curve = at.system->model().beam_of(at.system->model().joints[joint]).curve;
  const double s = *place(*at.system, at.state, joint);
  const double room = 0.4 * distance_to_others(at, joint);
  double ds = std::clamp(now < 0 ? body.move : -body.move, -room, room);
  if (!curve.closed()) ds = std::clamp(ds, -s, curve.length() - s);
  body.at_end = ds == 0;
  if (now == 0) ds = 0;
  if (ds == 0) body.move = 0;
  return ds;
}

// Brings `at` to rest.
class RestSearch {
 public:
  RestSearch(MeshedState& at, const LengthControl& control) : at_(at), control_(control) {}

  RestReport held_equilibrium() {
    hold_in_equilibrium(at_.system->mesh().plan);
    return std::move(report_);
  }

  RestReport rest(const std::function<bool()>& interrupted) {
    if (!goes_on(meeting_bodies(at_)) || !hold_in_equilibrium(at_.system->mesh().plan))
      return std::move(report_);
    std::vector<Descent> bodies;
    for (int j = 0; j < joints(); ++j) bodies.push_back({model().joints[j].motion ? 0 : spacing(j) / 4});
    for (int guard = 0; still_far(bodies); ++guard) {
      report_.interrupted = interrupted();
      const bool lost = guard > 2000 && !report_.interrupted;
      if (lost) report_.failure = Failure{.kind = Failure::Kind::resting_place};
      if (report_.interrupted || lost || !let_down(bodies)) return std::move(report_);
    }
    std::vector<bool> at_end;
    for (const Descent& body : bodies) at_end.push_back(body.at_end);
    free_bodies(at_end);
    return std::move(report_);
  }

 private:
  const BeamModel& model() const { return at_.system->model(); }
  int joints() const { return static_cast<int>(model().joints.size()); }
  double spacing(int joint) const { return home_spacing(model(), joint); }

  bool goes_on(std::optional<Failure> failure) {
    report_.failure = std::move(failure);
    return !report_.failure;
  }

  bool still_far(const std::vector<Descent>& bodies) const {
    for (int j = 0; j < joints(); ++j)
      if (bodies[j].move > 1e-6 * spacing(j)) return true;
    return false;
  }

  // One move of every body and the equilibrium after it.
  bool let_down(std::vector<Descent>& bodies) {
    std::vector<double> ds;
    for (int j = 0; j < joints(); ++j) ds.push_back(next_move(at_, j, bodies[j]));
    return move_places(std::move(ds)) && goes_on(meeting_bodies(at_)) && hold_in_equilibrium(moved_plan(at_));
  }

  // Equilibrium from the state as it is, which is kept on failure.
  StaticReport find_equilibrium(MeshedState& at) {
    at.state.lambda = Eigen::VectorXd::Zero(at.system->constraint_count());
    at.state.v = at.state.a = Eigen::VectorXd::Zero(at.system->coordinate_count());
    const StaticReport found = find_static_equilibrium(StaticEquilibrium{}, *at.system, at.state);
    report_.newton_iterations += found.newton_iterations;
    report_.load_steps += found.load_steps;
    return found;
  }

  // With all sliding bodies held where the plan has them.
  bool hold_in_equilibrium(MeshPlan plan) {
    const std::vector<bool> held(model().joints.size(), true);
    at_.system = std::make_unique<BeamSystem>(at_.system->shared_model(), std::move(plan), held);
    const StaticReport found = find_equilibrium(at_);
    if (found.status == StaticStatus::converged) return true;
    return goes_on(Failure{.kind = Failure::Kind::equilibrium, .equilibrium = found});
  }

  // Applies the changes of the mesh that are due.
  bool settle_mesh() {
    for (std::size_t count = 1;; ++count) {
      const auto start = std::chrono::steady_clock::now();
      const NextPlan next = next_plan(*at_.system, at_.state, control_);
      if (next.change == MeshChange::none) return true;
      if (!goes_on(change_mesh(at_, next, true).failure)) return false;
      report_.length_control_seconds +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (!goes_on(excess_of_changes(at_, count))) return false;
    }
  }

  // Moves held joints by ds, with the curve as it stands, and carries length control along: never past a node
  // at once.
  bool move_places(std::vector<double> ds) {
    while (std::any_of(ds.begin(), ds.end(), [](double rest) { return rest != 0; })) {
      for (int j = 0; j < joints(); ++j) {
        const double part = std::clamp(ds[j], -room_to_move(at_, j, -1), room_to_move(at_, j, 1));
        move_place(at_, j, part);
        ds[j] -= part;
      }
      if (!settle_mesh()) return false;
    }
    at_.state.v.setZero();
    return true;
  }

  // Equilibrium with the joints free that are not held, if there is one nearby; else nothing changes.
  void free_bodies(const std::vector<bool>& held) {
    MeshedState freed{std::make_unique<BeamSystem>(at_.system->shared_model(), at_.system->mesh().plan, held),
                      at_.state};
    bool near = find_equilibrium(freed).status == StaticStatus::converged;
    for (int j = 0; near && j < joints(); ++j) {
      const auto s = place(*freed.system, freed.state, j);
      near = !s || std::abs(*s - *place(*at_.system, at_.state, j)) < 1e-3 * spacing(j);
    }
    if (near) at_ = std::move(freed);
  }

  MeshedState& at_;
  const LengthControl& control_;
  RestReport report_;
};

}  // namespace

RestReport find_held_equilibrium(MeshedState& at) {
  return RestSearch(at, LengthControl{}).held_equilibrium();
}

RestReport find_rest(MeshedState& at, const LengthControl& control,
                     const std::function<bool()>& interrupted) {
  return RestSearch(at, control).rest(interrupted);
}

}  // namespace nurbeam
