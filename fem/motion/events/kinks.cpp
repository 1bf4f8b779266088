#include "fem/motion/events/kinks.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "fem/forces/load_place.h"

namespace nurbeam {

namespace {

// Adds the times at which a moving load leaves its beam: place_of() knows it up to twice its round-off beyond
// the end.
void add_leaving(const LoadAtPlace& load, const Beam& beam, std::vector<double>& times) {
  if (load.speed == 0 || beam.is_ring()) return;
  const double length = beam.curve.length(),
               way = (load.speed > 0 ? beam.curve.end() : beam.curve.start()) - load.s;
  times.push_back(way / load.speed);
  times.push_back((way + std::copysign(2e-12 * length, load.speed)) / load.speed);
}

// Calls visit(rows) for the curve through the rows of each component of a moved support, and of the angle of
// one that turns.
template <class Visit>
void for_each_moved_support(const BeamModel& model, const Visit& visit) {
  for (const Constraint& constraint : model.constraints) {
    if (const AxisTurn* turn = turn_of(constraint); turn && turn->angle.rows()) visit(*turn->angle.rows());
    std::visit(
        [&](const auto& c) {
          if constexpr (requires { c.motion; })
            if (c.motion)
              for (const RowCurve& component : c.motion->components()) visit(component);
        },
        constraint);
  }
}

// Adds the times of rows with a kink, or without one.
void add_rows(const BeamModel& model, bool with_kink, std::vector<double>& times) {
  const auto add = [&](const RowCurve& motion) {
    for (std::size_t row = 0; row < motion.rows().size(); ++row)
      if (motion.bends_at(row) == with_kink) times.push_back(motion.rows()[row].first);
  };
  for (const Rider& rider : model.riders)
    if (rider.motion && rider.motion->rows()) add(*rider.motion->rows());
  for_each_moved_support(model, add);
}

std::vector<double> in_order(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

bool jumps(const std::pair<double, double>& speeds) {
  constexpr double same_speed = 1e-12;  // relative
  const auto [before, after] = speeds;
  return std::abs(after - before) > same_speed * (std::abs(before) + std::abs(after));
}

}  // namespace

std::vector<double> kink_times(const BeamModel& model) {
  std::vector<double> times;
  const auto add = [&](const TimeTable& table) {
    for (const auto& [time, value] : table) times.push_back(time);
  };
  for (const Rider& rider : model.riders) {
    if (rider.friction) add(rider.friction->force);
    if (rider.release) times.push_back(*rider.release);
  }
  for (const Force& force : model.forces)
    std::visit(
        [&](const auto& f) {
          if constexpr (requires { f.time; }) add(f.time);
          if constexpr (std::is_base_of_v<LoadAtPlace, std::decay_t<decltype(f)>>)
            add_leaving(f, model.beams[f.beam], times);
        },
        force);
  for (const Beam& beam : model.beams) add(beam.properties.free_strain.thermal);
  add_rows(model, true, times);
  return in_order(std::move(times));
}

std::vector<double> seam_times(const BeamModel& model) {
  std::vector<double> times;
  add_rows(model, false, times);
  return in_order(std::move(times));
}

double end_of_jump(const std::vector<double>& times, double time, double resolution) {
  constexpr double apart = 100;
  const auto beyond = std::upper_bound(times.begin(), times.end(), time + resolution);
  const auto after = std::upper_bound(times.begin(), beyond, time);
  if (after == beyond) return time;
  const double last = *(beyond - 1);
  return beyond == times.end() || *beyond - last > apart * (last - time) ? last : time;
}

std::vector<MotionKink> motion_kinks(const BeamModel& model, double time) {
  std::vector<MotionKink> kinks;
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j) {
    const std::optional<PlaceMotion>& motion = model.riders[j].motion;
    if (!motion || !motion->rows()) continue;
    const std::optional<std::pair<double, double>> speeds = motion->rows()->slopes_at(time);
    if (speeds && jumps(*speeds)) kinks.push_back({j, speeds->first, speeds->second});
  }
  return kinks;
}

bool support_speed_jumps(const BeamModel& model, double time) {
  bool any = false;
  for_each_moved_support(model, [&](const RowCurve& motion) {
    const std::optional<std::pair<double, double>> speeds = motion.slopes_at(time);
    any = any || (speeds && jumps(*speeds));
  });
  return any;
}

}  // namespace nurbeam
