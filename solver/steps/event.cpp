#include "solver/steps/event.h"

#include <algorithm>

namespace nurbeam {

State land_before(Integrator& integrator, const StepTaken& taken,
                  const std::function<double(const State&)>& g, double near, bool leaves) {
  constexpr double shortest = 1e-7;  // part of the step, by which the search may still change it
  const double step = taken.length;
  const auto missed = [&](const State& state) { return g(state) + near / 2; };
  const auto repeat = [&](double length) {
    const StepReport report = integrator.repeat(taken.before, taken.history, length);
    if (taken.iterations) *taken.iterations += report.newton_iterations;
    return report.status == StepStatus::converged;
  };
  double lo = 0, f_lo = missed(taken.before), hi = step, f_hi = missed(taken.after);
  State landed = taken.before;
  for (double trial = step / 2; leaves && f_lo >= -near / 2 && trial > shortest * step; trial /= 2) {
    if (!repeat(trial)) continue;
    const double f = missed(integrator.state());
    if (f > 0) {
      hi = trial;
      f_hi = f;
    } else {
      lo = trial;
      f_lo = f;
      landed = integrator.state();
    }
    if (f < -near / 2) break;
  }
  while (f_lo < -near / 2 && hi - lo > shortest * step) {
    // Regula falsi, kept off the ends.
    const double fraction = f_hi > 0 ? std::clamp(-f_lo / (f_hi - f_lo), 0.02, 0.98) : 0.5;
    const double trial = lo + fraction * (hi - lo);
    if (!repeat(trial)) {
      hi = trial;
      f_hi = 0;
      continue;
    }
    const double f = missed(integrator.state());
    (f < near / 2 ? lo : hi) = trial;
    (f < near / 2 ? f_lo : f_hi) = f;
    if (f < near / 2) landed = integrator.state();
  }
  return landed;
}

}  // namespace nurbeam
