#include "fem/motion/run.h"

#include <algorithm>
#include <utility>

#include "fem/system/observables.h"
#include "solver/consistent.h"

namespace nurbeam {

bool Run::restart(const std::vector<int>& changed) {
  // Other methods than this one want accelerations that are consistent everywhere.
  const std::vector<int> around =
      std::holds_alternative<GeneralizedAlpha>(options.integrator) ? changed : std::vector<int>{};
  const double time = shortest_time();
  NearSolver solver;
  const auto smooth = [&](MeshedState& of) {
    return make_accelerations_smooth(*of.system, time, around, solver, of.state) == ConsistencyStatus::done;
  };
  if (!smooth(at)) return fail(Failure::Kind::mass_matrix);
  if (observer.follower) observer.follower->starts(at, time, around, smooth);
  const Integrator* before = around.empty() ? nullptr : integrator.get();
  integrator = start_integrator(options.integrator, *at.system, at.state, before);
  restarted = true;
  return true;
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
