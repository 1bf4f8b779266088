#include "pipelines/crossing.h"

#include <algorithm>
#include <cmath>

#include "pipelines/sliding_bodies.h"

namespace nurbeam {

namespace {

// The place that a body crosses on its way; where there are several, the first.
template <int D>
std::optional<double> crossed_place(const BeamSystem<D>& system, int joint, double from, double to) {
  const BeamModel& model = system.model();
  const double near = 2 * landing_tolerance(model, joint);  // the joint may turn round where it has landed
  if (system.mesh().plan.modes[joint] == JointMode::point) {
    const Beam& beam = model.beams[model.joints[joint].beam];
    const int h = beam.home_interval(system.mesh().plan.places[joint]);
    if (to > beam.home_place(h + 1) + near && (beam.is_ring() || h + 1 < beam.home_intervals()))
      return beam.home_place(h + 1);
    if (to < beam.home_place(h) - near && (beam.is_ring() || h > 0)) return beam.home_place(h);
    return std::nullopt;
  }
  const ReferenceCurve& curve = curve_of(model, joint);
  std::optional<double> crossed;
  const double last = std::max(from, to);
  for (double s = curve.next_break(std::min(from, to)); s < last; s = curve.next_break(s))
    if (std::abs(s - from) > near && (!crossed || to < from)) crossed = s;  // the one nearest to `from`
  return crossed;
}

// How far the body is beyond the place; negative before it [m].
template <int D>
double distance_beyond(const BeamSystem<D>& system, const State& state, const Crossing& crossing) {
  const double s = *system.place(state, crossing.joint);
  return crossing.forward ? s - crossing.s : crossing.s - s;
}

}  // namespace

template <int D>
std::optional<Crossing> first_crossing(const BeamSystem<D>& system, const State& before, const State& after) {
  std::optional<Crossing> first;
  double earliest = 1;
  for (int j = 0; j < static_cast<int>(system.model().joints.size()); ++j) {
    const auto s = system.place(after, j);
    if (!s) continue;
    const double from = *system.place(before, j);
    const std::optional<double> crossed = crossed_place(system, j, from, *s);
    if (!crossed || (*crossed - from) / (*s - from) >= earliest) continue;
    earliest = (*crossed - from) / (*s - from);
    first = Crossing{j, *crossed, *s > from};
  }
  return first;
}

template <int D>
std::optional<Crossing> end_passed(const BeamSystem<D>& system, const State& state) {
  for (int j = 0; j < static_cast<int>(system.model().joints.size()); ++j) {
    const ReferenceCurve& curve = curve_of(system.model(), j);
    if (curve.closed() || system.mesh().plan.modes[j] != JointMode::point) continue;
    const double s = *system.place(state, j);
    if (s < 0) return Crossing{j, 0, false};
    if (s > curve.length()) return Crossing{j, curve.length(), true};
  }
  return std::nullopt;
}

double landing_tolerance(const BeamModel& model, int joint) {
  return 1e-10 * curve_of(model, joint).length();
}

template <int D>
State landed(const BeamSystem<D>& system, const IntegratorSettings& settings, const State& before,
             const Eigen::VectorXd& algorithmic, const State& after, double step, const Crossing& crossing) {
  const double near = landing_tolerance(system.model(), crossing.joint);
  const auto missed = [&](const State& state) { return distance_beyond(system, state, crossing) + near / 2; };
  double lo = 0, f_lo = missed(before), hi = step, f_hi = missed(after);
  State state = before;
  while (f_lo < -near / 2 && hi - lo > 1e-7 * step) {
    const double fraction = f_hi > 0 ? std::clamp(-f_lo / (f_hi - f_lo), 0.02, 0.98) : 0.5;
    const double trial = lo + fraction * (hi - lo);
    const std::unique_ptr<Integrator> integrator = repeat_step(settings, system, before, algorithmic);
    if (integrator->advance(trial).status != StepStatus::converged) {
      hi = trial;
      f_hi = 0;
      continue;
    }
    const double f = missed(integrator->state());
    (f < near / 2 ? lo : hi) = trial;
    (f < near / 2 ? f_lo : f_hi) = f;
    if (f < near / 2) state = integrator->state();
  }
  return state;
}

template <int D>
State carried_over(const BeamSystem<D>& system, State state, double step, const Crossing& crossing) {
  const double gap =
      landing_tolerance(system.model(), crossing.joint) - distance_beyond(system, state, crossing);
  const double instant =
      std::clamp(gap / std::abs(system.place_rate(state, crossing.joint)), 0.0, 1e-6 * step);
  state.q += instant * state.v;
  state.t += instant;
  return state;
}

template std::optional<Crossing> first_crossing<2>(const BeamSystem<2>&, const State&, const State&);
template std::optional<Crossing> first_crossing<3>(const BeamSystem<3>&, const State&, const State&);
template std::optional<Crossing> end_passed<2>(const BeamSystem<2>&, const State&);
template std::optional<Crossing> end_passed<3>(const BeamSystem<3>&, const State&);
template State landed<2>(const BeamSystem<2>&, const IntegratorSettings&, const State&,
                         const Eigen::VectorXd&, const State&, double, const Crossing&);
template State landed<3>(const BeamSystem<3>&, const IntegratorSettings&, const State&,
                         const Eigen::VectorXd&, const State&, double, const Crossing&);
template State carried_over<2>(const BeamSystem<2>&, State, double, const Crossing&);
template State carried_over<3>(const BeamSystem<3>&, State, double, const Crossing&);

}  // namespace nurbeam
