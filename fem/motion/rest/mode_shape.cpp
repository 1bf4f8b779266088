#include "fem/motion/rest/mode_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/system/initial_state.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

double size_of(const MeshedState& at) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& nodes : at.system->mesh().nodes)
    for (const MeshNode& node : nodes) {
      const Eigen::Vector3d r = vector_at(*at.system, at.state.q, node.r);
      low = low.cwiseMin(r);
      high = high.cwiseMax(r);
    }
  return (high - low).norm();
}

}  // namespace

double visible_amplitude(const MeshedState& at, const Mode& mode) {
  constexpr double part = 0.05, turn = 0.5;
  const double size = size_of(at);
  double largest = 0;  // largest ratio of a quantity to its limit
  const auto look_at = [&](int first, double limit) {
    largest = std::max(largest, vector_at(*at.system, mode.shape, first).norm() / limit);
  };
  for (const auto& nodes : at.system->mesh().nodes)
    for (const MeshNode& node : nodes) {
      look_at(node.r, part * size);
      look_at(node.slope_left, turn);
      look_at(node.slope_right, turn);
      for (const int angle : {node.angle_left, node.angle_right})
        if (angle >= 0) largest = std::max(largest, std::abs(mode.shape[angle]) / turn);
      if (node.place >= 0) largest = std::max(largest, std::abs(mode.shape[node.place]) / (part * size));
    }
  for (const int r : at.system->mesh().bodies) look_at(r, part * size);
  return largest > 0 ? 1 / largest : 0;
}

Snapshot record_mode(const MeshedState& at, const Mode& mode, double amount, double rate,
                     const std::vector<ProbePlace>& probes) {
  Snapshot snapshot = record_snapshot(*at.system, at.state, probes);
  State moved = at.state;
  moved.q += amount * mode.shape;
  moved.v = rate * mode.shape;
  const Snapshot there = record_snapshot(*at.system, moved, probes);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    static_cast<PointRecord&>(snapshot.probes[i]) = there.probes[i];
    snapshot.probes[i].displacement = there.probes[i].displacement;
  }
  for (std::size_t i = 0; i < snapshot.bodies.size(); ++i) {
    snapshot.bodies[i].point = there.bodies[i].point;
    snapshot.bodies[i].s = there.bodies[i].s;
  }
  for (std::size_t b = 0; b < snapshot.beams.size(); ++b) {
    BeamRecord& beam = snapshot.beams[b];
    const BeamRecord& shape = there.beams[b];
    for (std::size_t e = 0; e < beam.elements.size(); ++e) {
      beam.elements[e].control_points = shape.elements[e].control_points;
      beam.elements[e].velocity = shape.elements[e].velocity;
    }
    beam.node_positions = shape.node_positions;
    beam.node_slopes = shape.node_slopes;
    beam.length = shape.length;
  }
  return snapshot;
}

}  // namespace nurbeam
