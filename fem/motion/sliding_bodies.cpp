#include "fem/motion/sliding_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/system/observables.h"

namespace nurbeam {

double home_spacing(const BeamModel& model, int joint) {
  const Beam& beam = model.beam_of(model.joints[joint]);
  return beam.curve.length() / beam.home_intervals();
}

double distance_to_others(const MeshedState& at, int joint) {
  const BeamModel& model = at.system->model();
  double distance = std::numeric_limits<double>::infinity();
  for (int other = 0; other < static_cast<int>(model.joints.size()); ++other) {
    const auto s = place(*at.system, at.state, other);
    if (other == joint || !s || model.joints[other].beam != model.joints[joint].beam) continue;
    const double here = *place(*at.system, at.state, joint);
    const ReferenceCurve& curve = model.beam_of(model.joints[joint]).curve;
    distance = std::min(distance, std::abs(curve.unrolled(*s, here) - here));
  }
  return distance;
}

std::vector<BodyPlace> places_of(const MeshedState& at) {
  const BeamModel& model = at.system->model();
  std::vector<BodyPlace> places;
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j)
    if (const auto s = place(*at.system, at.state, j))
      places.push_back(
          {j, model.beam_of(model.joints[j]).curve.wrapped(*s), place_rate(*at.system, at.state, j)});
  return places;
}

std::optional<Failure> meeting_bodies(const MeshedState& at) {
  const BeamModel& model = at.system->model();
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
    const double nearest = meeting_distance * home_spacing(model, j);
    if (place(*at.system, at.state, j) && distance_to_others(at, j) <= nearest)
      return Failure{.kind = Failure::Kind::bodies_meet, .time = at.state.t, .places = places_of(at)};
  }
  return std::nullopt;
}

}  // namespace nurbeam
