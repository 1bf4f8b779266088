#include "fem/motion/events/crossing.h"

#include <algorithm>
#include <cmath>

#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// The first place that a rider has passed since the mesh was made. A landing just before the place does not
// count yet: the rider may turn round there.
std::optional<double> crossed_place(const BeamSystem& system, int rider, double s) {
  const BeamModel& model = system.model();
  const MeshPlan& plan = system.mesh().plan;
  const Beam& beam = model.beam_of(model.riders[rider]);
  const bool is_point = plan.modes[rider] == Carried::point, forward = s > plan.places[rider];
  const double beyond = s + (forward ? -2 : 2) * landing_tolerance(model, rider);
  const auto inside = [&](int h) { return beam.is_ring() || (h > 0 && h < beam.home_intervals()); };
  for (int h = beam.home_interval(plan.places[rider]) + (forward ? 1 : 0);
       inside(h) && (forward ? beam.home_place(h) < beyond : beam.home_place(h) > beyond);
       h += forward ? 1 : -1)
    if (is_point || beam.home_node(h).permanent) return beam.home_place(h);
  return std::nullopt;
}

}  // namespace

std::optional<Crossing> first_crossing(const BeamSystem& system, const State& before, const State& after) {
  std::optional<Crossing> first;
  double earliest = 1;
  for (int j = 0; j < static_cast<int>(system.model().riders.size()); ++j) {
    const auto s = place(system, after, j);
    if (!s) continue;
    const std::optional<double> crossed = crossed_place(system, j, *s);
    if (!crossed) continue;
    const double from = *place(system, before, j), part = (*crossed - from) / (*s - from);
    if (part >= earliest) continue;
    earliest = part;
    first = Crossing{j, *crossed, *s > *crossed};
  }
  return first;
}

std::optional<Crossing> end_reached(const BeamSystem& system, const State& state, int rider, bool forward) {
  const ReferenceCurve& curve = system.model().beam_of(system.model().riders[rider]).curve;
  const double end = forward ? curve.end() : curve.start();
  if (curve.closed() || std::abs(*place(system, state, rider) - end) > 1e-9 * curve.length()) return {};
  return Crossing{rider, end, forward};
}

std::optional<Crossing> end_passed(const BeamSystem& system, const State& state) {
  const BeamModel& model = system.model();
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j) {
    const Rider& rider = model.riders[j];
    const ReferenceCurve& curve = model.beam_of(rider).curve;
    const bool by_table = rider.motion && rider.motion->rows();  // a table is known to stay on the beam
    const Carried mode = system.mesh().plan.modes[j];
    const bool comes_to_end = mode == Carried::point || (mode == Carried::node && rider.reel);
    if (curve.closed() || by_table || !comes_to_end) continue;
    const double s = *place(system, state, j), beyond = landing_tolerance(model, j);
    if (s < curve.start() - beyond) return Crossing{j, curve.start(), false};
    if (s > curve.end() + beyond) return Crossing{j, curve.end(), true};
  }
  return std::nullopt;
}

bool is_held(const BeamModel& model, const Crossing& end) {
  const Beam& beam = model.beam_of(model.riders[end.rider]);
  const HomeNode& node = end.forward ? beam.home.back() : beam.home.front();
  return node.hold != Hold::nothing || node.joined;
}

double landing_tolerance(const BeamModel& model, int rider) {
  return 1e-10 * model.beam_of(model.riders[rider]).curve.length();
}

double distance_beyond(const BeamSystem& system, const State& state, const Crossing& crossing) {
  const double s = *place(system, state, crossing.rider);
  return crossing.forward ? s - crossing.s : crossing.s - s;
}

State landed(const BeamSystem& system, Integrator& integrator, const StepTaken& taken,
             const Crossing& crossing) {
  return land_before(
      integrator, taken, [&](const State& state) { return distance_beyond(system, state, crossing); },
      landing_tolerance(system.model(), crossing.rider));
}

State between(const State& from, const State& to, double part) {
  const double h = to.t - from.t, x = part, y = 1 - part;
  State state = to;
  state.t = from.t + part * h;
  state.q = y * y * (1 + 2 * x) * from.q + x * x * (1 + 2 * y) * to.q + h * x * y * (y * from.v - x * to.v);
  state.v = y * from.v + x * to.v;
  return state;
}

State carried_over(const BeamSystem& system, State state, double step, const Crossing& crossing) {
  const double gap =
      landing_tolerance(system.model(), crossing.rider) - distance_beyond(system, state, crossing);
  const double instant =
      std::clamp(gap / std::abs(place_rate(system, state, crossing.rider)), 0.0, 1e-6 * step);
  state.q += instant * state.v;
  state.t += instant;
  return state;
}

}  // namespace nurbeam
