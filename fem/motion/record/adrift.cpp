#include "fem/motion/record/adrift.h"

#include <algorithm>
#include <numeric>
#include <variant>

#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// Of each body the first one of those that connectors tie to each other.
std::vector<int> tied_groups(const BeamModel& model) {
  std::vector<int> group(model.bodies.size());
  std::iota(group.begin(), group.end(), 0);
  for (const Connector& connector : model.connectors) {
    const int a = connector.ends[0].body, b = connector.ends[1].body;
    if (a < 0 || b < 0) continue;
    const int kept = std::min(group[a], group[b]), gone = std::max(group[a], group[b]);
    std::replace(group.begin(), group.end(), gone, kept);
  }
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (const std::optional<BodyPoint>& point = model.bodies[i].point_of) {
      const int kept = std::min(group[i], group[point->body]), gone = std::max(group[i], group[point->body]);
      std::replace(group.begin(), group.end(), gone, kept);
    }
  return group;
}

}  // namespace

std::vector<bool> bodies_adrift(const BeamSystem& system, const State& state) {
  const BeamModel& model = system.model();
  const std::size_t count = model.bodies.size();
  std::vector<bool> has_left(count), held(count), adrift(count);
  if (model.riders.empty()) return adrift;
  const std::vector<int> group = tied_groups(model);
  for (int i = 0; i < static_cast<int>(model.riders.size()); ++i)
    (place(system, state, i) ? held : has_left)[group[model.riders[i].body]] = true;
  for (const Connector& connector : model.connectors)
    for (int end : {0, 1})
      if (connector.ends[end].body >= 0 && connector.ends[1 - end].body < 0)
        held[group[connector.ends[end].body]] = true;
  for (const Constraint& constraint : model.constraints)
    if (const int body = std::visit([](const auto& c) { return c.place(); }, constraint).body; body >= 0)
      held[group[body]] = true;
  for (std::size_t b = 0; b < count; ++b) adrift[b] = has_left[group[b]] && !held[group[b]];
  return adrift;
}

double kinetic_energy_adrift(const BeamSystem& system, const State& state, const std::vector<bool>& adrift) {
  double energy = 0;
  for (std::size_t b = 0; b < adrift.size(); ++b)
    if (adrift[b])
      energy += system.model().bodies[b].mass *
                vector_at(system, state.v, system.mesh().bodies[b]).squaredNorm() / 2;
  return energy;
}

}  // namespace nurbeam
