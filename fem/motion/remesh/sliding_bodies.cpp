#include "fem/motion/remesh/sliding_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// The least distance of other bodies on its beam from a rider's [m].
double nearest(const BeamModel& model, int rider) {
  const bool rigid = model.beam_of(model.riders[rider]).rigid;
  return (rigid ? touching_distance : meeting_distance) * home_spacing(model, rider);
}

}  // namespace

double home_spacing(const BeamModel& model, int rider) {
  const Beam& beam = model.beam_of(model.riders[rider]);
  return beam.curve.length() / beam.home_intervals();
}

double distance_between(const MeshedState& at, int rider, int other) {
  const BeamModel& model = at.system->model();
  const auto here = place(*at.system, at.state, rider), there = place(*at.system, at.state, other);
  if (rider == other || !here || !there || model.riders[other].beam != model.riders[rider].beam)
    return std::numeric_limits<double>::infinity();
  return std::abs(model.beam_of(model.riders[rider]).curve.unrolled(*there, *here) - *here);
}

double distance_to_others(const MeshedState& at, int rider) {
  double distance = std::numeric_limits<double>::infinity();
  for (int other = 0; other < static_cast<int>(at.system->model().riders.size()); ++other)
    distance = std::min(distance, distance_between(at, rider, other));
  return distance;
}

bool kept_apart(const BeamModel& model, int rider, int other) {
  const auto place = [&](int j) { return model.riders[j].s; };
  if (place(rider) > place(other)) std::swap(rider, other);
  const bool closed = model.beam_of(model.riders[rider]).curve.closed();
  return std::any_of(model.stops.begin(), model.stops.end(), [&](const Stop& stop) {
    if (stop.other < 0) return false;
    if (std::minmax(stop.rider, stop.other) == std::minmax(rider, other)) return true;
    if (closed || model.riders[stop.rider].beam != model.riders[rider].beam) return false;
    // A stop of another body between the two counts, as no body passes another.
    const auto [near, far] = place(stop.rider) < place(stop.other) ? std::pair(stop.rider, stop.other)
                                                                   : std::pair(stop.other, stop.rider);
    return near == rider && place(far) < place(other) && kept_apart(model, far, other);
  });
}

std::vector<BodyPlace> places_of(const MeshedState& at) {
  const BeamModel& model = at.system->model();
  std::vector<BodyPlace> places;
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j)
    if (const auto s = place(*at.system, at.state, j))
      places.push_back(
          {j, model.beam_of(model.riders[j]).curve.wrapped(*s), place_rate(*at.system, at.state, j)});
  return places;
}

Failure meeting(const MeshedState& at, int rider, int other) {
  return {.kind = Failure::Kind::bodies_meet,
          .time = at.state.t,
          .places = places_of(at),
          .rider = rider,
          .other = other,
          .distance = distance_between(at, rider, other),
          .nearest = nearest(at.system->model(), rider)};
}

std::optional<Failure> meeting_bodies(const MeshedState& at) {
  const BeamModel& model = at.system->model();
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j)
    for (int other = 0; other < j; ++other)
      if (!kept_apart(model, other, j) && distance_between(at, other, j) <= nearest(model, j))
        return meeting(at, other, j);
  return std::nullopt;
}

}  // namespace nurbeam
