#include "fem/motion/events/kinks.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "fem/forces/load_place.h"

namespace nurbeam {

namespace {

// Slopes of a table on both sides of one of its rows.
std::pair<double, double> slopes_at(const TimeTable& table, std::size_t row) {
  const auto slope = [&](std::size_t from) {
    return (table[from + 1].second - table[from].second) / (table[from + 1].first - table[from].first);
  };
  return {row > 0 ? slope(row - 1) : 0, row + 1 < table.size() ? slope(row) : 0};
}

// Adds the times at which a moving load leaves its beam: place_of() knows it up to twice its round-off beyond
// the end.
void add_leaving(const LoadAtPlace& load, const Beam& beam, std::vector<double>& times) {
  if (load.speed == 0 || beam.is_ring()) return;
  const double length = beam.curve.length(), way = load.speed > 0 ? length - load.s : -load.s;
  times.push_back(way / load.speed);
  times.push_back((way + std::copysign(2e-12 * length, load.speed)) / load.speed);
}

}  // namespace

std::vector<double> kink_times(const BeamModel& model) {
  std::vector<double> times;
  const auto add = [&](const TimeTable& table) {
    for (const auto& [time, value] : table) times.push_back(time);
  };
  for (const Rider& rider : model.riders) {
    if (rider.motion) add(rider.motion->rows());
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
  for (const Constraint& constraint : model.constraints)
    std::visit(
        [&](const auto& c) {
          if constexpr (requires { c.motion; })
            if (c.motion)
              for (const auto& [time, value] : c.motion->rows()) times.push_back(time);
        },
        constraint);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
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
  constexpr double same_speed = 1e-12;  // relative
  std::vector<MotionKink> kinks;
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j) {
    if (!model.riders[j].motion) continue;
    const TimeTable& table = model.riders[j].motion->rows();
    for (std::size_t row = 0; row < table.size(); ++row) {
      if (table[row].first != time) continue;
      const auto [before, after] = slopes_at(table, row);
      if (std::abs(after - before) > same_speed * (std::abs(before) + std::abs(after)))
        kinks.push_back({j, before, after});
    }
  }
  return kinks;
}

}  // namespace nurbeam
