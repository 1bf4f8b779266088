#include "fem/motion/rest/mode_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "fem/element/quadrature.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
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

// Looks at the displacements of a mode inside the element of a span [m]. `moved`: the state with a small
// amount of the mode.
template <class LookAt>
void look_inside(const MeshedState& at, const State& moved, double amount, int span, const LookAt& look_at) {
  constexpr int parts = 8;
  const MeshSpan& of = at.system->mesh().spans[span];
  for (int i = 1; i < parts; ++i) {
    const auto position = [&](const State& state) {
      const double x = i / static_cast<double>(parts);
      return material_point_in(*at.system, state, span, (1 - x) * of.start(state.q) + x * of.end(state.q)).r;
    };
    look_at(((position(moved) - position(at.state)) / amount).norm());
  }
}

// The greatest displacement of a beam from its drawing, by the cubics of its elements alone: no forces belong
// to the moved state.
Extreme greatest_displacement(const BeamSystem& system, const State& state, int beam) {
  constexpr int parts = 16;
  const ReferenceCurve& curve = system.model().beams[beam].curve;
  const Mesh& mesh = system.mesh();
  Extreme greatest{0, 0};
  for (int i = mesh.first_span[beam]; i < mesh.first_span[beam + 1]; ++i)
    for (int k = 0; k <= parts; ++k) {
      const double x = k / static_cast<double>(parts);
      const double s = (1 - x) * mesh.spans[i].start(state.q) + x * mesh.spans[i].end(state.q);
      const double distance = (material_point_in(system, state, i, s).r - curve.position(s)).norm();
      if (distance > greatest.value) greatest = {distance, curve.wrapped(s)};
    }
  return greatest;
}

// The displacement of a mode at a Gauss point, and its derivatives by s.
struct DisplacedPoint {
  int beam;
  double ds;  // weight of the point [m]
  Eigen::Vector3d tangent, d, d_s, d_ss;
};

template <class LookAt>
void for_each_displacement(const MeshedState& at, const Mode& mode, const LookAt& look_at) {
  constexpr double amount = 1e-6;
  const Mesh& mesh = at.system->mesh();
  State moved = at.state;
  moved.q += amount * mode.shape;
  for (int i = 0; i < static_cast<int>(mesh.spans.size()); ++i) {
    const MeshSpan& span = mesh.spans[i];
    const double s_a = span.start(at.state.q), length = span.end(at.state.q) - s_a;
    for (int g = 0; g < GaussRule::size; ++g) {
      const double s = s_a + GaussRule::points[g] * length;
      const MaterialPoint<3> here = material_point_in(*at.system, at.state, i, s),
                             there = material_point_in(*at.system, moved, i, s);
      look_at(DisplacedPoint{span.beam, GaussRule::weights[g] * length, here.rs.normalized(),
                             (there.r - here.r) / amount, (there.rs - here.rs) / amount,
                             (there.rss - here.rss) / amount});
    }
  }
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
  constexpr double amount = 1e-6;
  State moved = at.state;
  moved.q += amount * mode.shape;
  for (int i = 0; i < static_cast<int>(at.system->mesh().spans.size()); ++i)
    look_inside(at, moved, amount, i,
                [&](double displacement) { largest = std::max(largest, displacement / (part * size)); });
  for (const int r : at.system->mesh().bodies) look_at(r, part * size);
  return largest > 0 ? 1 / largest : 0;
}

BendingWave bending_wave(const MeshedState& at, const Mode& mode) {
  constexpr double bends_much = 0.1;
  const BeamModel& model = at.system->model();
  BendingWave shortest;
  double bending = 0;
  std::vector<std::array<double, 2>> sums(model.beams.size());  // of w^2 and w_ss^2
  for_each_displacement(at, mode, [&](const DisplacedPoint& point) {
    const auto across = [&](const Eigen::Vector3d& d) {
      return (d - d.dot(point.tangent) * point.tangent).squaredNorm();
    };
    sums[point.beam][0] += point.ds * across(point.d);
    sums[point.beam][1] += point.ds * across(point.d_ss);
  });
  for (std::size_t b = 0; b < sums.size(); ++b)
    if (!model.beams[b].rigid) bending += model.beams[b].properties.bent_energy(std::sqrt(sums[b][1]), 1);
  if (!(bending > mode.omega * mode.omega / 4)) return shortest;
  for (std::size_t b = 0; b < sums.size(); ++b) {
    const BeamProperties& beam = model.beams[b].properties;
    if (model.beams[b].rigid || beam.bent_energy(std::sqrt(sums[b][1]), 1) < bends_much * bending) continue;
    const double half = std::numbers::pi * std::pow(sums[b][0] / sums[b][1], 0.25),
                 diameter = 2 * beam.radius_of_disk();
    if (shortest.beam < 0 || half / diameter < shortest.diameters)
      shortest = {static_cast<int>(b), half, half / diameter};
  }
  return shortest;
}

WaveResolution wave_resolution(const MeshedState& at, const Mode& mode) {
  constexpr double moves_much = 0.1;  // of the largest mean square
  const BeamModel& model = at.system->model();
  const Mesh& mesh = at.system->mesh();
  std::vector<std::array<double, 3>> sums(model.beams.size());  // of d^2, d_s^2 and d_ss^2
  for_each_displacement(
      at, mode,
      [&](const DisplacedPoint& point) {
        sums[point.beam][0] += point.ds * point.d.squaredNorm();
        sums[point.beam][1] += point.ds * point.d_s.squaredNorm();
        sums[point.beam][2] += point.ds * point.d_ss.squaredNorm();
      });
  const auto mean_square = [&](std::size_t b) { return sums[b][0] / model.beams[b].curve.length(); };
  double largest = 0;
  for (std::size_t b = 0; b < sums.size(); ++b) largest = std::max(largest, mean_square(b));
  WaveResolution worst;
  for (std::size_t b = 0; b < sums.size(); ++b) {
    const int elements = mesh.first_span[b + 1] - mesh.first_span[b];
    if (elements == 0 || mean_square(b) < moves_much * largest) continue;
    const double length = model.beams[b].curve.length(),
                 half = std::numbers::pi * std::sqrt(sums[b][1] / sums[b][2]);
    if (const double each = half * elements / length; worst.beam < 0 || each < worst.per_half_wave)
      worst = {static_cast<int>(b), elements, half, each};
  }
  return worst;
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
    beam.displacement_max = greatest_displacement(*at.system, moved, static_cast<int>(b));
  }
  return snapshot;
}

}  // namespace nurbeam
