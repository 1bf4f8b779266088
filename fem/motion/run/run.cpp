#include "fem/motion/run/run.h"

#include <algorithm>
#include <utility>

#include "fem/motion/rest/free_lengths.h"
#include "fem/system/observables.h"
#include "solver/system/consistent.h"

namespace nurbeam {

bool Run::restart() {
  const double time = shortest_time();
  // Steps of such methods close constraints of places only. A much shorter first step would take the errors
  // left in velocities for an impact.
  const bool closed =
      time == 0 || change([&](MeshedState& of) {
        return project_velocities(*of.system, of.state, time).status == ConsistencyStatus::done;
      });
  if (!closed) return fail(Failure::Kind::mass_matrix);
  const auto smooth = [&](MeshedState& of) {
    return make_accelerations_smooth(*of.system, time, of.state) == ConsistencyStatus::done;
  };
  if (!smooth(at)) return fail(Failure::Kind::mass_matrix);
  if (observer.follower) observer.follower->starts(at, {.h = time}, smooth);
  start_afresh(nullptr);
  return true;
}

bool Run::restart_balanced(const std::vector<int>& around) {
  // Other methods need accelerations that are consistent everywhere.
  if (!damps_fast_motions(options.integrator)) return restart();
  const double time = shortest_time();
  NearSolver solver;
  const auto balance = [&](MeshedState& of) {
    return balance_accelerations(*of.system, time, around, solver, of.state);
  };
  const std::optional<Eigen::VectorXd> before = observer.follower ? std::optional(at.state.a) : std::nullopt;
  const Balance found = balance(at);
  if (found.status != ConsistencyStatus::done) return fail(Failure::Kind::mass_matrix);
  if (observer.follower)
    observer.follower->starts(at, {time, found.near ? around : std::vector<int>{}, before},
                              [&](MeshedState& of) { return balance(of).status == ConsistencyStatus::done; });
  start_afresh(around.empty() ? nullptr : integrator.get());
  return true;
}

bool Run::restart_after_jump() {
  // Derivatives by a follower are those of a method that starts afresh.
  auto* own = dynamic_cast<GeneralizedAlphaIntegrator*>(integrator.get());
  if (!own || observer.follower) return restart();
  NearSolver solver;
  const Eigen::VectorXd before = at.state.a;
  if (balance_accelerations(*at.system, shortest_time(), {}, solver, at.state).status !=
      ConsistencyStatus::done)
    return fail(Failure::Kind::mass_matrix);
  own->jump_to(at.state, at.state.a - before);
  restarted = true;
  return true;
}

void Run::start_afresh(const Integrator* before) {
  integrator = start_integrator(options.integrator, *at.system, at.state, before);
  restarted = true;
}

void Run::note(RunEvent event) {
  if (observer.follower) observer.follower->happens(event);
  report.events.push_back(std::move(event));
}

Checkpoint Run::checkpoint() const {
  Checkpoint point;
  point.plan = at.system->mesh().plan;
  point.state = at.state;
  point.history = integrator->history();
  point.next_step = step;
  point.last_step = last_step;
  point.transient = transient;
  point.restarted = restarted;
  point.dissipated = account.dissipated();
  point.input = account.input();
  point.start_energy = account.start();
  for (const Connector& connector : model->connectors) point.connector_lengths.push_back(connector.length);
  point.steps = steps;
  point.peaks = peaks.numbers();
  return point;
}

void Run::go_on_from(const Checkpoint& point) {
  model = with_lengths(*model, point.connector_lengths);
  at = {std::make_unique<BeamSystem>(model, point.plan), point.state};
  integrator = start_integrator(options.integrator, *at.system, at.state);
  integrator->restore(point.state, point.history);
  step = options.step.value_or(point.next_step);
  last_step = point.last_step;
  transient = point.transient;
  restarted = point.restarted;
  account = EnergyAccount(point.dissipated, point.input, point.start_energy);
  steps = point.steps;
  peaks.go_on_from(point.peaks, at.system, at.state);
  report = point.report;
  report.energy_noise = energy_noise(*model);
}

bool Run::goes_on(std::optional<Failure> failure) {
  if (!failure) return true;
  report.fail(std::move(*failure));
  return false;
}

bool Run::fail_in_impact(int rider) {
  return goes_on(Failure{.kind = Failure::Kind::impact, .time = at.state.t, .rider = rider});
}

namespace {

bool has_attitudes(const BeamSystem& system) {
  return std::ranges::any_of(
      system.mesh().attitudes, [](int p) { return p >= 0; });
}

// With velocities on the constraints, and with accelerations that belong to them, as steps close positions
// alone. Where beams deform, accelerations are averaged over a step of that length.
State settled(const BeamSystem& system, const State& state, double length) {
  State closed = state;
  if (project_velocities(system, closed).status != ConsistencyStatus::done) return state;
  if (std::ranges::all_of(system.model().beams, &Beam::rigid))
    return make_accelerations_consistent(system, closed) == ConsistencyStatus::done ? closed : state;
  NearSolver solver;
  const Balance balance = balance_accelerations(system, length, {}, solver, closed);
  return balance.status == ConsistencyStatus::done ? closed : state;
}

}  // namespace

State Run::at_the_moment(const BeamSystem& system, const State& state, double length) const {
  if (options.step || observer.follower) return state;
  if (has_attitudes(system)) return settled(system, state, length);
  if ((system.constraint_curvature(state) + system.constraint_product(state, state.a)).isZero(0))
    return state;
  State balanced = state;
  NearSolver solver;
  const Balance balance = balance_accelerations(system, length, {}, solver, balanced);
  return balance.status == ConsistencyStatus::done ? balanced : state;
}

double Run::shortest_time() const {
  if (!damps_fast_motions(options.integrator)) return 0;
  return transient > 0 ? std::min(step, transient) : step;
}

double Run::resolution() const { return std::max(1e-12 * options.end_time, 1e-5 * step); }

double Run::mechanical_energy() const { return energy(*at.system, at.state).mechanical(); }

}  // namespace nurbeam
