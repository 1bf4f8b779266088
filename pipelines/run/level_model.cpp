#include "pipelines/run/level_model.h"

#include <algorithm>
#include <cmath>

#include "pipelines/case/limits.h"
#include "pipelines/model/slopes.h"

namespace nurbeam {

namespace {

// Elements of a beam that may have half or a quarter of them.
constexpr int least_for_half = 6, least_for_quarter = 8;

// Whether a beam needs its node there.
bool is_needed(const HomeNode& node) {
  return node.permanent || node.kind != NodeKind::smooth || node.hold != Hold::nothing || node.joined ||
         node.kept || node.sharp || node.sharp_clamp;
}

// A place by the number of elements before it, which need not be whole.
double place_at(const std::vector<HomeNode>& home, double number) {
  const std::size_t i = std::min(static_cast<std::size_t>(number), home.size() - 2);
  return home[i].s + (number - static_cast<double>(i)) * (home[i + 1].s - home[i].s);
}

int fewest_in_ring(const BeamModel& model, int beam) {
  const auto riders = std::ranges::count_if(model.riders, [&](const Rider& r) { return r.beam == beam; });
  return 4 + 2 * static_cast<int>(riders);
}

// Takes every second node away, where nothing needs it; of an odd number of elements half of one more stays
// out. Returns whether there are enough elements for that.
bool double_elements(BeamModel& model, int b) {
  Beam& beam = model.beams[b];
  std::vector<HomeNode> home = {beam.home.front()};
  for (std::size_t first = 0, last = 1; last < beam.home.size(); ++last) {
    if (last + 1 < beam.home.size() && !is_needed(beam.home[last])) continue;
    const std::size_t before = last - first, after = before / 2;
    if (after == 0) return false;
    for (std::size_t i = 1; i < after; ++i)
      home.push_back({.s = place_at(beam.home, static_cast<double>(first) + static_cast<double>(i * before) /
                                                                                static_cast<double>(after))});
    home.push_back(beam.home[last]);
    first = last;
  }
  beam.home = std::move(home);
  return !beam.is_ring() || beam.home_intervals() >= fewest_in_ring(model, b);
}

}  // namespace

void halve_elements(Beam& beam) {
  std::vector<HomeNode> home;
  for (int h = 0; h < beam.home_intervals(); ++h) {
    home.push_back(beam.home[h]);
    home.push_back({.s = (beam.home_place(h) + beam.home_place(h + 1)) / 2});
  }
  home.push_back(beam.home.back());
  beam.home = std::move(home);
}

std::optional<BeamModel> model_at_level(const BeamModel& model, int level) {
  BeamModel made = model;
  for (int k = 0; k < std::abs(level); ++k)
    for (int b = 0; b < static_cast<int>(made.beams.size()); ++b) {
      Beam& beam = made.beams[b];
      if (beam.rigid) continue;
      if (level < 0 && !double_elements(made, b)) return std::nullopt;
      if (level > 0 && 2 * beam.home_intervals() > most_elements) return std::nullopt;
      if (level > 0) halve_elements(beam);
    }
  return made;
}

std::optional<BuiltModel> at_level(const BuiltModel& built, int level) {
  const int least = level < -1 ? least_for_quarter : level < 0 ? least_for_half : 1;
  const auto is_short = [&](const Beam& beam) { return !beam.rigid && beam.home_intervals() < least; };
  if (std::ranges::any_of(built.model.beams, is_short)) return std::nullopt;
  std::optional<BeamModel> model = model_at_level(built.model, level);
  if (!model) return std::nullopt;
  BuiltModel made = built;
  made.model = std::move(*model);
  if (level > 0) smooth_fine_kinks(made.model, made.slopes);
  return made;
}

long element_count(const BeamModel& model) {
  long count = 0;
  for (const Beam& beam : model.beams)
    if (!beam.rigid) count += beam.home_intervals();
  return count;
}

}  // namespace nurbeam
