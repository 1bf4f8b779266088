#include "fem/motion/sliding_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nurbs/number_text.h"

namespace nurbeam {

const std::string& body_name(const BeamModel& model, int joint) {
  return model.bodies[model.joints[joint].body].name;
}

const ReferenceCurve& curve_of(const BeamModel& model, int joint) {
  return model.beams[model.joints[joint].beam].curve;
}

double home_spacing(const BeamModel& model, int joint) {
  const Beam& beam = model.beams[model.joints[joint].beam];
  return beam.curve.length() / beam.home_intervals();
}

template <int D>
double distance_to_others(const BeamSystem<D>& system, const State& state, int joint) {
  const BeamModel& model = system.model();
  double distance = std::numeric_limits<double>::infinity();
  for (int other = 0; other < static_cast<int>(model.joints.size()); ++other) {
    const auto s = system.place(state, other);
    if (other == joint || !s || model.joints[other].beam != model.joints[joint].beam) continue;
    const double here = *system.place(state, joint);
    distance = std::min(distance, std::abs(curve_of(model, joint).unrolled(*s, here) - here));
  }
  return distance;
}

template <int D>
std::string places_text(const BeamSystem<D>& system, const State& state) {
  const BeamModel& model = system.model();
  std::string places;
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j)
    if (const auto s = system.place(state, j))
      places += "; \"" + body_name(model, j) + "\" is at s = " + text_of(curve_of(model, j).wrapped(*s), 8) +
                " m of beam \"" + model.beams[model.joints[j].beam].name +
                "\" with ds/dt = " + text_of(system.place_rate(state, j), 8) + " m/s";
  return places;
}

template <int D>
bool check_bodies_apart(const BeamSystem<D>& system, const State& state, SimulationReport& report) {
  for (int j = 0; j < static_cast<int>(system.model().joints.size()); ++j) {
    const double nearest = meeting_distance * home_spacing(system.model(), j);
    if (!system.place(state, j) || distance_to_others(system, state, j) > nearest) continue;
    report.fail(SimulationStatus::not_converged, "sliding bodies meet at t = " + text_of(state.t, 8) +
                                                     " s; contact between bodies is not modelled" +
                                                     places_text(system, state));
    return false;
  }
  return true;
}

template double distance_to_others<2>(const BeamSystem<2>&, const State&, int);
template double distance_to_others<3>(const BeamSystem<3>&, const State&, int);
template std::string places_text<2>(const BeamSystem<2>&, const State&);
template std::string places_text<3>(const BeamSystem<3>&, const State&);
template bool check_bodies_apart<2>(const BeamSystem<2>&, const State&, SimulationReport&);
template bool check_bodies_apart<3>(const BeamSystem<3>&, const State&, SimulationReport&);

}  // namespace nurbeam
