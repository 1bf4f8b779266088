#include "fem/motion/resting_place.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fem/motion/sliding_bodies.h"
#include "nurbs/number_text.h"
#include "solver/static_equilibrium.h"

namespace nurbeam {

namespace {

// Equilibrium from the state as it is, which is kept on failure.
template <int D>
StaticReport find_equilibrium(MeshedState<D>& at, SimulationReport& report) {
  at.state.lambda = Eigen::VectorXd::Zero(at.system->constraint_count());
  at.state.v = at.state.a = Eigen::VectorXd::Zero(at.system->coordinate_count());
  const StaticReport found = find_static_equilibrium(
      StaticEquilibrium{}, *at.system, [&](double factor) { at.system->set_load_factor(factor); }, at.state);
  report.newton_iterations += found.newton_iterations;
  report.steps += found.load_steps;
  return found;
}

// With all sliding bodies held where the plan has them.
template <int D>
bool hold_in_equilibrium(MeshedState<D>& at, MeshPlan plan, SimulationReport& report) {
  const BeamModel& model = at.system->model();
  const std::vector<bool> held(model.joints.size(), true);
  at.system = std::make_unique<BeamSystem<D>>(model, std::move(plan), held);
  const StaticReport found = find_equilibrium(at, report);
  if (found.status == StaticStatus::converged) return true;
  report.fail(SimulationStatus::not_converged,
              std::string("no static equilibrium was found: ") +
                  (found.status == StaticStatus::singular_matrix
                       ? "the tangent is singular (is the model held everywhere?)"
                       : "the solver does not converge") +
                  "; load factor reached " + text_of(found.load_factor, 8));
  return false;
}

// Applies the changes of the mesh that are due.
template <int D>
bool settle_mesh(MeshedState<D>& at, const LengthControl& control, SimulationReport& report) {
  for (std::size_t count = 1;; ++count) {
    const auto start = std::chrono::steady_clock::now();
    const NextPlan next = next_plan<D>(*at.system, at.state, control);
    if (next.change == MeshChange::none) return true;
    Eigen::VectorXd impulse;
    if (!change_mesh(at, next, true, impulse, report)) return false;
    report.length_control_seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!check_changes(at, count, report)) return false;
  }
}

// How far a joint can move in a direction while its elements keep a fifth of their length [m].
template <int D>
double room_to_move(const MeshedState<D>& at, int joint, int direction) {
  const Mesh<D>& mesh = at.system->mesh();
  const int node = mesh.joints[joint].node;
  if (node < 0) return std::numeric_limits<double>::infinity();
  const int beam = at.system->model().joints[joint].beam, first = mesh.first_element[beam];
  const int count = mesh.first_element[beam + 1] - first;
  const MeshElement<D>& e = mesh.elements[first + (direction > 0 ? node : (node + count - 1) % count)];
  return 0.8 * (end_of<D>(e, at.state.q) - start_of<D>(e, at.state.q));
}

template <int D>
void move_place(MeshedState<D>& at, int joint, double ds) {
  const Mesh<D>& mesh = at.system->mesh();
  const MeshJoint& moved = mesh.joints[joint];
  if (moved.place < 0 || ds == 0) return;
  State& state = at.state;
  const double s = state.q[moved.place] + ds;
  const int beam = at.system->model().joints[joint].beam;
  const auto& e = mesh.elements[find_element<D>(at.system->model(), mesh, state.q, beam, s)];
  const MaterialPoint<D> p = material_point<D>(e, state.q, state.v, s);
  state.q.template segment<D>(moved.r) = p.r;
  if (moved.node >= 0)
    for (int slope : {mesh.nodes[beam][moved.node].slope_left, mesh.nodes[beam][moved.node].slope_right})
      state.q.template segment<D>(slope) = p.rs;
  state.q[moved.place] = s;
  state.v[moved.place] = ds;  // length control looks at the direction
}

// Moves held joints by ds, with the curve as it stands, and carries length control along: never past a node
// at once.
template <int D>
bool move_places(MeshedState<D>& at, std::vector<double> ds, const LengthControl& control,
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
template <int D>
MeshPlan moved_plan(const MeshedState<D>& at) {
  MeshPlan plan = at.system->mesh().plan;
  for (std::size_t j = 0; j < plan.places.size(); ++j)
    if (const auto s = at.system->place(at.state, static_cast<int>(j))) plan.places[j] = *s;
  return plan;
}

// A sliding body on its way to where it rests.
struct Descent {
  double move;          // the next one's length [m]; 0 when the body has arrived
  double force = 0;     // that held it before the last one [N]
  bool at_end = false;  // of the beam
};

// The next move of a body [m], down the slope: what holds it shows where it does not want to go.
template <int D>
double next_move(const MeshedState<D>& at, int joint, Descent& body) {
  if (body.move == 0) return 0;
  const double now = at.system->holding_force(at.state, joint);
  if (body.force * now < 0) body.move /= 2;
  body.force = now;
  const ReferenceCurve& curve = curve_of(at.system->model(), joint);
  const double s = *at.system->place(at.state, joint);
  const double room = 0.4 * distance_to_others(*at.system, at.state, joint);
  double ds = std::clamp(now < 0 ? body.move : -body.move, -room, room);
  if (!curve.closed()) ds = std::clamp(ds, -s, curve.length() - s);
  body.at_end = ds == 0;
  if (now == 0) ds = 0;
  if (ds == 0) body.move = 0;
  return ds;
}

// Equilibrium with the joints free that are not held, if there is one nearby; else nothing changes.
template <int D>
void free_bodies(MeshedState<D>& at, const std::vector<bool>& held, SimulationReport& report) {
  const BeamModel& model = at.system->model();
  MeshedState<D> freed{std::make_unique<BeamSystem<D>>(model, at.system->mesh().plan, held), at.state};
  bool near = find_equilibrium(freed, report).status == StaticStatus::converged;
  for (int j = 0; near && j < static_cast<int>(held.size()); ++j) {
    const auto s = freed.system->place(freed.state, j);
    near = !s || std::abs(*s - *at.system->place(at.state, j)) < 1e-3 * home_spacing(model, j);
  }
  if (near) at = std::move(freed);
}

}  // namespace

template <int D>
bool find_held_equilibrium(MeshedState<D>& at, SimulationReport& report) {
  return hold_in_equilibrium(at, at.system->mesh().plan, report);
}

template <int D>
void find_rest(MeshedState<D>& at, const LengthControl& control, const std::function<bool()>& interrupted,
               SimulationReport& report) {
  if (!check_bodies_apart(*at.system, at.state, report) || !find_held_equilibrium(at, report)) return;
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
    if (guard > 2000)
      return report.fail(SimulationStatus::not_converged, "a sliding body finds no resting place");
    if (interrupted()) return report.fail(SimulationStatus::interrupted, "interrupted");
    std::vector<double> ds;
    for (int j = 0; j < n; ++j) ds.push_back(next_move(at, j, bodies[j]));
    if (!move_places(at, ds, control, report)) return;
    if (!check_bodies_apart(*at.system, at.state, report) || !hold_in_equilibrium(at, moved_plan(at), report))
      return;
  }
  std::vector<bool> at_end;
  for (const Descent& body : bodies) at_end.push_back(body.at_end);
  free_bodies(at, at_end, report);
}

template bool find_held_equilibrium<2>(MeshedState<2>&, SimulationReport&);
template bool find_held_equilibrium<3>(MeshedState<3>&, SimulationReport&);
template void find_rest<2>(MeshedState<2>&, const LengthControl&, const std::function<bool()>&,
                           SimulationReport&);
template void find_rest<3>(MeshedState<3>&, const LengthControl&, const std::function<bool()>&,
                           SimulationReport&);

}  // namespace nurbeam
