#include "fem/motion/crossing.h"

#include <algorithm>
#include <cmath>

#include "fem/motion/sliding_bodies.h"

namespace nurbeam {

namespace {

// The first place, seen from where the joint was when the mesh was made, that it has passed by now. A landing
// just before it is not yet that: the joint may turn round there.
template <int D>
std::optional<double> crossed_place(const BeamSystem<D>& system, int joint, double s) {
  const BeamModel& model = system.model();
  const MeshPlan& plan = system.mesh().plan;
  const Beam& beam = model.beams[model.joints[joint].beam];
  const bool is_point = plan.modes[joint] == JointMode::point, forward = s > plan.places[joint];
  const double beyond = s + (forward ? -2 : 2) * landing_tolerance(model, joint);
  const auto inside = [&](int h) { return beam.is_ring() || (h > 0 && h < beam.home_intervals()); };
  for (int h = beam.home_interval(plan.places[joint]) + (forward ? 1 : 0);
       inside(h) && (forward ? beam.home_place(h) < beyond : beam.home_place(h) > beyond);
       h += forward ? 1 : -1)
    if (is_point || beam.home[beam.home_index(h)].late) return beam.home_place(h);
  return std::nullopt;
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
    const std::optional<double> crossed = crossed_place(system, j, *s);
    if (!crossed) continue;
    const double from = *system.place(before, j), part = (*crossed - from) / (*s - from);
    if (part >= earliest) continue;
    earliest = part;
    first = Crossing{j, *crossed, *s > *crossed};
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
