#include "fem/motion/run.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "fem/system/observables.h"
#include "solver/consistent.h"

namespace nurbeam {

bool Run::restart() {
  const double time = shortest_time();
  const auto smooth = [&](MeshedState& of) {
    return make_accelerations_smooth(*of.system, time, of.state) == ConsistencyStatus::done;
  };
  if (!smooth(at)) return fail(Failure::Kind::mass_matrix);
  if (observer.follower) observer.follower->starts(at, {averaged_over(time)}, smooth);
  start_afresh(nullptr);
  return true;
}

bool Run::restart_balanced() {
  // Other methods want accelerations that are consistent everywhere.
  if (!std::holds_alternative<GeneralizedAlpha>(options.integrator) ||
      at.system->forces_depend_on_multipliers()) {
    if (!restart()) return false;
    at.state = integrator->state();
    return true;
  }
  std::optional<State> before;
  if (observer.follower) before = at.state;
  start_afresh(integrator.get());
  const auto averaged = dynamic_cast<GeneralizedAlphaIntegrator&>(*integrator).balance(shortest_time());
  if (!averaged) return fail(Failure::Kind::mass_matrix);
  at.state = integrator->state();
  if (!observer.follower) return true;
  NearSolver solver;
  observer.follower->starts(at, {*averaged, std::move(before)}, [&](MeshedState& of) {
    return balance_accelerations(*of.system, *averaged, solver, of.state) == ConsistencyStatus::done;
  });
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

bool Run::goes_on(std::optional<Failure> failure) {
  if (!failure) return true;
  report.fail(std::move(*failure));
  return false;
}

bool Run::fail_in_impact(int joint) {
  return goes_on(Failure{.kind = Failure::Kind::impact, .time = at.state.t, .joint = joint});
}

double Run::shortest_time() const {
  if (!std::holds_alternative<GeneralizedAlpha>(options.integrator)) return 0;
  return transient > 0 ? std::min(step, transient) : step;
}

double Run::resolution() const { return std::max(1e-12 * std::max(1.0, options.end_time), 1e-5 * step); }

double Run::mechanical_energy() const { return energy(*at.system, at.state).mechanical(); }

}  // namespace nurbeam
