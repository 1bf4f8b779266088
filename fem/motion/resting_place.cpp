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

// Equilibrium from the state as it is, which is kept on failure.
StaticReport find_equilibrium(MeshedState& at, SimulationReport& report) {
  at.state.lambda = Eigen::VectorXd::Zero(at.system->constraint_count());
  at.state.v = at.state.a = Eigen::VectorXd::Zero(at.system->coordinate_count());
  const StaticReport found = find_static_equilibrium(StaticEquilibrium{}, *at.system, at.state);
  report.newton_iterations += found.newton_iterations;
  report.steps += found.load_steps;
  return found;
}

// With all sliding bodies held where the plan has them.
bool hold_in_equilibrium(MeshedState& at, MeshPlan plan, SimulationReport& report) {
  const std::vector<bool> held(at.system->model().joints.size(), true);
  at.system = std::make_unique<BeamSystem>(at.system->shared_model(), std::move(plan), held);
  const StaticReport found = find_equilibrium(at, report);
  if (found.status == StaticStatus::converged) return true;
  report.fail({.kind = Failure::Kind::equilibrium, .equilibrium = found});
  return false;
}

// Applies the changes of the mesh that are due.
bool settle_mesh(MeshedState& at, const LengthControl& control, SimulationReport& report) {
  for (std::size_t count = 1;; ++count) {
    const auto start = std::chrono::steady_clock::now();
    const NextPlan next = next_plan(*at.system, at.state, control);
    if (next.change == MeshChange::none) return true;
    Eigen::VectorXd impulse;
    if (!change_mesh(at, next, true, impulse, report)) return false;
    report.length_control_seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!check_changes(at, count, report)) return false;
  }
}

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

// Moves held joints by ds, with the curve as it stands, and carries length control along: never past a node
// at once.
bool move_places(MeshedState& at, std::vector<double> ds, const LengthControl& control,
                 SimulationReport& report) {
  while (std::any_of(ds.begin(), ds.end(), [](double rest) { return rest != 0; })) {
    for (int j = 0; j < static_cast<int>(ds.size()); ++j) {
      const double part = std::clamp(ds[j], -room_to_move(at, j, -1), room_to_move(at, j, 1));
      move_place(at, j, part);
      ds[j] -= part;
    }
    if (!settle_mesh(at, control, report)) return false;
  }
  at.state.v.setZero();
  return true;
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

// Equilibrium with the joints free that are not held, if there is one nearby; else nothing changes.
void free_bodies(MeshedState& at, const std::vector<bool>& held, SimulationReport& report) {
  const BeamModel& model = at.system->model();
  MeshedState freed{std::make_unique<BeamSystem>(at.system->shared_model(), at.system->mesh().plan, held),
                    at.state};
  bool near = find_equilibrium(freed, report).status == StaticStatus::converged;
  for (int j = 0; near && j < static_cast<int>(held.size()); ++j) {
    const auto s = place(*freed.system, freed.state, j);
    near = !s || std::abs(*s - *place(*at.system, at.state, j)) < 1e-3 * home_spacing(model, j);
  }
  if (near) at = std::move(freed);
}

}  // namespace

bool find_held_equilibrium(MeshedState& at, SimulationReport& report) {
  return hold_in_equilibrium(at, at.system->mesh().plan, report);
}

void find_rest(MeshedState& at, const LengthControl& control, const std::function<bool()>& interrupted,
               SimulationReport& report) {
  if (!check_bodies_apart(at, report) || !find_held_equilibrium(at, report)) return;
  const BeamModel& model = at.system->model();
  const int n = static_cast<int>(model.joints.size());
  std::vector<Descent> bodies;
  for (int j = 0; j < n; ++j) bodies.push_back({model.joints[j].motion ? 0 : home_spacing(model, j) / 4});
  const auto still_far = [&] {
    for (int j = 0; j < n; ++j)
      if (bodies[j].move > 1e-6 * home_spacing(model, j)) return true;
    return false;
  };
  for (int guard = 0; still_far(); ++guard) {
    if (guard > 2000) return report.fail({.kind = Failure::Kind::resting_place});
    if (interrupted()) {
      report.status = SimulationStatus::interrupted;
      return;
    }
    std::vector<double> ds;
    for (int j = 0; j < n; ++j) ds.push_back(next_move(at, j, bodies[j]));
    if (!move_places(at, ds, control, report)) return;
    if (!check_bodies_apart(at, report) || !hold_in_equilibrium(at, moved_plan(at), report)) return;
  }
  std::vector<bool> at_end;
  for (const Descent& body : bodies) at_end.push_back(body.at_end);
  free_bodies(at, at_end, report);
}

}  // namespace nurbeam
