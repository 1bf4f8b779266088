#include "fem/mesh/mesh_plan.h"

#include <algorithm>
#include <cmath>

namespace nurbeam {

namespace {

// The home node that gives way to a moving node at s, or -1; a node at an end never does.
int node_to_replace(const Beam& beam, double s) {
  const int h = beam.home_interval(s);
  const auto at = [&](int i) { return beam.home_place(i); };
  const auto can_go = [&](int i) {
    if (!beam.is_ring() && (i <= 0 || i >= beam.home_intervals())) return false;
    return beam.home_node(i).kind == NodeKind::smooth;
  };
  const bool first = can_go(h) && (!can_go(h + 1) || s - at(h) <= at(h + 1) - s);
  const int nearest = first ? h : h + 1;
  if (!can_go(nearest)) return -1;
  const double gap = at(nearest) < s ? at(nearest + 1) - at(nearest) : at(nearest) - at(nearest - 1);
  const double reach = beam.home_node(nearest).permanent ? passing_zone : 0.5;
  return std::abs(at(nearest) - s) <= reach * gap ? beam.home_index(nearest) : -1;
}

// Takes out the home nodes that are on the reel of a rider, and one that is at its mouth.
void store(const Beam& beam, const Rider& rider, std::vector<bool>& present) {
  for (std::size_t h = 0; h < present.size(); ++h)
    if (rider.reel->sense() * (beam.home[h].s - rider.s) <= 0) present[h] = false;
}

}  // namespace

bool too_light_for_node(const Structure& structure, const Rider& rider) {
  constexpr double light = 0.01;
  const Beam& beam = structure.beam_of(rider);
  const double limit = light * beam.properties.mass_per_length, mass = structure.body_of(rider).mass;
  return rider.continuous_slope && !rider.motion && mass > 0 && mass <= limit * beam.curve.length() &&
         mass <= limit * beam.home_spacing(rider.s);
}

Passing passing(const Rider& rider, const HomeNode& node) {
  if (rider.reel) return node.permanent ? Passing::gives_way : Passing::as_node;
  if (node.kind == NodeKind::kink) return Passing::as_point;
  if (!node.permanent) return Passing::as_node;
  const bool stays = rider.continuous_slope || node.hold != Hold::nothing || node.kept;
  return stays ? Passing::as_point : Passing::gives_way;
}

bool near_as_point(const Structure& structure, const Rider& rider, double s, double reach) {
  if (rider.reel) return false;
  const Beam& beam = structure.beam_of(rider);
  if (beam.rigid || rider.as_point || too_light_for_node(structure, rider)) return true;
  const int before = beam.home_interval(s);
  const double distance = reach * (beam.home_place(before + 1) - beam.home_place(before));
  const auto near = [&](int h) {
    const HomeNode& node = beam.home_node(h);
    return std::abs(beam.home_place(h) - s) <= distance && node.is_passed() &&
           passing(rider, node) == Passing::as_point;
  };
  return near(before) || near(before + 1);
}

MeshPlan initial_plan(const Structure& structure) {
  MeshPlan plan;
  for (const Beam& beam : structure.beams) plan.beams.push_back({std::vector<bool>(beam.home.size(), true)});
  for (const Rider& rider : structure.riders) {
    const Beam& beam = structure.beam_of(rider);
    const double from_end = std::min(rider.s - beam.curve.start(), beam.curve.end() - rider.s);
    const bool near_end = !beam.is_ring() && !rider.reel && from_end < end_zone * beam.home_spacing(rider.s);
    const bool on_point = near_end || near_as_point(structure, rider, rider.s, passing_zone);
    plan.modes.push_back(on_point ? Carried::point : Carried::node);
    plan.places.push_back(rider.s);
    plan.held.push_back(rider.release.has_value());
    if (on_point) continue;
    if (rider.reel) store(beam, rider, plan.beams[rider.beam].present);
    const int replaced = node_to_replace(beam, rider.s);
    if (replaced >= 0) plan.beams[rider.beam].present[replaced] = false;
  }
  return plan;
}

}  // namespace nurbeam
