#include "fem/system/bending_layers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "fem/material/bending_layer.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// One side of a place: the direction of the beam beyond the layer there, and the tension that the layer has.
struct Side {
  Eigen::Vector3d along;  // of unit length, towards the beam's end
  double tension;
  SectionLoads loads;  // axial force and torque alone
};

// Fibre and von Mises stress of a section, as far as it gives them.
std::pair<double, double> stresses(const Beam& beam, const SectionLoads& loads, double moment) {
  constexpr double none = SectionRecord::no_number;
  if (!beam.has_torsion()) return {beam.section.fibre_stress(loads.axial_force, moment).value_or(none), none};
  if (!beam.stresses) return {none, none};
  const SectionStresses::Largest largest = beam.stresses->largest(loads);
  return {largest.normal, largest.von_mises};
}

void blank_bending(SectionRecord& section) {
  section.bending_moment = section.shear_force = section.stress = section.moment_1 = section.moment_2 =
      section.von_mises = SectionRecord::no_number;
}

class LayersOfBeam {
 public:
  LayersOfBeam(const BeamSystem& system, const State& state, const CarriedBySpans& carried, int b,
               int only_span)
      : system_(system),
        state_(state),
        carried_(carried),
        b_(b),
        beam_(system.model().beams[b]),
        first_(system.mesh().first_span[b]),
        spans_(system.mesh().first_span[b + 1] - first_),
        only_span_(only_span) {}

  BendingLayers find() {
    const std::vector<MeshNode>& nodes = system_.mesh().nodes[b_];
    for (int i = 0; i < static_cast<int>(nodes.size()); ++i) look_at_node(i, nodes[i]);
    look_at_clamps();
    for (int j = 0; j < static_cast<int>(system_.model().riders.size()); ++j) look_at_point(j);
    std::sort(found_.unseen.begin(), found_.unseen.end());
    return std::move(found_);
  }

 private:
  // Spans before and behind a node; -1 beyond an end.
  int before(int node) const {
    return node > 0 ? first_ + node - 1 : beam_.is_ring() ? first_ + spans_ - 1 : -1;
  }
  int behind(int node) const { return node < spans_ ? first_ + node : -1; }

  bool is_asked(int span) const { return only_span_ < 0 || span == only_span_; }

  void look_at_node(int i, const MeshNode& node) {
    if (before(i) < 0 || behind(i) < 0 || !(is_asked(before(i)) || is_asked(behind(i)))) return;
    const bool is_kink = node.rider >= 0 ? !system_.model().riders[node.rider].continuous_slope
                                         : beam_.home[node.home].kind == NodeKind::kink;
    const bool is_sharp =
        node.rider >= 0 ? system_.model().riders[node.rider].sharp : beam_.home[node.home].sharp;
    if (!is_kink && !is_sharp) return;
    const double rate = node.place >= 0 ? state_.v[node.place] : 0;
    const Eigen::Vector3d left = vector_at(system_, state_.q, node.slope_left),
                          right = vector_at(system_, state_.q, node.slope_right);
    add(place(behind(i), 0), behind(i), side(before(i), 1, rate, is_kink ? &left : nullptr),
        side(behind(i), 0, rate, is_kink ? &right : nullptr));
    if (!is_kink)
      for (const int span : {before(i), behind(i)}) found_.unseen.push_back(span);
  }

  // A body that is carried as a point makes a kink that its element has not.
  void look_at_point(int j) {
    const Rider& rider = system_.model().riders[j];
    const Mesh& mesh = system_.mesh();
    if (rider.beam != b_ || mesh.plan.modes[j] != Carried::point || (rider.continuous_slope && !rider.sharp))
      return;
    const double s = state_.q[mesh.riders[j].place], rate = state_.v[mesh.riders[j].place];
    const int span = find_span(system_.model(), mesh, state_.q, b_, s);
    if (!is_asked(span)) return;
    add(beam_.curve.wrapped(s), span, side(span, 0, rate, nullptr), side(span, 1, rate, nullptr));
    found_.unseen.push_back(span);
  }

  void look_at_clamps() {
    const std::vector<MeshNode>& nodes = system_.mesh().nodes[b_];
    for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
      const MeshNode& node = nodes[i];
      if (node.home < 0 || !beam_.home[node.home].sharp_clamp) continue;
      const Eigen::Vector3d held = beam_.curve.tangent(node.s, node.s > 0).normalized(),
                            left = vector_at(system_, state_.q, node.slope_left),
                            right = vector_at(system_, state_.q, node.slope_right);
      drop_kink(node);
      if (before(i) >= 0) add_clamp(before(i), side(before(i), 1, 0, &left), held, 1);
      if (behind(i) >= 0) add_clamp(behind(i), side(behind(i), 0, 0, &right), held, -1);
    }
  }

  // Inside a beam a clamp has a layer on each side, and no kink.
  void drop_kink(const MeshNode& node) {
    std::erase_if(
        found_.layers, [&](const LayerRecord& layer) { return layer.s == node.s; });
  }

  // A side by the slope at its end, or, without one, by the section force there. `rate`: ds/dt of the place.
  Side side(int span, int end, double rate, const Eigen::Vector3d* slope) const {
    const MeshSpan& of = system_.mesh().spans[span];
    const double s = end == 0 ? of.start(state_.q) : of.end(state_.q);
    const SpanResultants carried = carried_[span];
    const SectionRecord section = section_at(system_, state_, span, carried, s);
    const MaterialPoint<3> p = material_point_in(system_, state_, span, s);
    const double stretch = p.rs.norm(), flow = beam_.properties.mass_per_length * stretch * rate * rate;
    const Eigen::Vector3d force = carried.at(s, p.r, p.rs).force + section.axial_force * p.rs / stretch;
    return {slope ? slope->normalized() : Eigen::Vector3d(force.normalized()),
            section.axial_force - flow,
            {.axial_force = section.axial_force, .torque = section.torque}};
  }

  // Axes of the section at the start of a span, on a beam with torsion.
  std::optional<SectionTriad<double>> axes(int span) const {
    if (!beam_.has_torsion()) return {};
    return section_point(system_, state_, b_, place(span, 0)).triad;
  }

  void add(double s, int span, const Side& a, const Side& b) {
    LayerRecord& layer = found_.layers.emplace_back(LayerRecord{.s = s});
    if (!(a.tension > 0) || !(b.tension > 0)) return;
    const Eigen::Vector3d turn = a.along.cross(b.along);
    const double angle = std::atan2(turn.norm(), a.along.dot(b.along));
    const Eigen::Vector2d across = components(axes(span), turn);
    const bool behind = std::abs(b.loads.axial_force) > std::abs(a.loads.axial_force);
    fill(layer, kink_layer(beam_.properties, angle, a.tension, b.tension, across), turn, across,
         behind ? b.loads : a.loads);
  }

  // `sign`: 1 where the clamp holds the end of the span, -1 where its start.
  void add_clamp(int span, const Side& side, const Eigen::Vector3d& held, int sign) {
    LayerRecord& layer = found_.layers.emplace_back(LayerRecord{.s = place(span, sign > 0 ? 1 : 0)});
    if (!(side.tension > 0)) return;
    const Eigen::Vector3d turn = sign * side.along.cross(held);
    const double angle = std::atan2(turn.norm(), side.along.dot(held));
    const Eigen::Vector2d across = components(axes(span), turn);
    fill(layer, clamp_layer(beam_.properties, angle, side.tension, across), turn, across, side.loads);
  }

  double place(int span, int end) const {
    const MeshSpan& of = system_.mesh().spans[span];
    return beam_.curve.wrapped(end == 0 ? of.start(state_.q) : of.end(state_.q));
  }

  static Eigen::Vector2d components(const std::optional<SectionTriad<double>>& axes,
                                    const Eigen::Vector3d& turn) {
    const Eigen::Vector2d across =
        axes ? Eigen::Vector2d(turn.dot(axes->d1), turn.dot(axes->d2)) : Eigen::Vector2d::Zero();
    return across.norm() > 0 ? Eigen::Vector2d(across.normalized()) : Eigen::Vector2d::UnitX();
  }

  void fill(LayerRecord& layer, const BendingLayer& bent, const Eigen::Vector3d& turn,
            const Eigen::Vector2d& across, SectionLoads loads) const {
    layer.reach = bent.reach;
    layer.moment = system_.dimension() == 2 ? std::copysign(bent.moment, turn.z()) : bent.moment;
    if (beam_.has_torsion()) {
      layer.moment_1 = loads.moment_1 = bent.moment * across[0];
      layer.moment_2 = loads.moment_2 = bent.moment * across[1];
    }
    std::tie(layer.stress, layer.von_mises) = stresses(beam_, loads, bent.moment);
  }

  const BeamSystem& system_;
  const State& state_;
  const CarriedBySpans& carried_;
  int b_;
  const Beam& beam_;
  int first_, spans_, only_span_;
  BendingLayers found_;
};

}  // namespace

BendingLayers bending_layers(const BeamSystem& system, const State& state, const CarriedBySpans& carried,
                             int beam, int only_span) {
  return LayersOfBeam(system, state, carried, beam, only_span).find();
}

SectionRecord with_layers(const Beam& beam, const BendingLayers& layers, int span, double s,
                          const SectionRecord& by_mesh) {
  constexpr double seen = 20;  // in reaches; beyond it a layer is nothing
  const bool is_unseen = std::binary_search(layers.unseen.begin(), layers.unseen.end(), span);
  SectionRecord section = by_mesh;
  if (is_unseen) section.bending_moment = section.moment_1 = section.moment_2 = 0;
  bool is_layer = false, is_slack = false;
  for (const LayerRecord& layer : layers.layers) {
    const double away = std::abs(beam.curve.unrolled(layer.s, s) - s);
    is_slack = is_slack || (std::isnan(layer.reach) && away <= 1e-9 * beam.curve.length());
    if (!(away < seen * layer.reach)) continue;
    const double part = std::exp(-away / layer.reach);
    is_layer = true;
    section.bending_moment += part * layer.moment;
    if (!beam.has_torsion()) continue;
    section.moment_1 += part * layer.moment_1;
    section.moment_2 += part * layer.moment_2;
    section.bending_moment = std::hypot(section.moment_1, section.moment_2);
  }
  if (is_slack || (is_unseen && !is_layer)) {
    blank_bending(section);
    return section;
  }
  if (is_layer)
    std::tie(section.stress, section.von_mises) = stresses(beam,
                                                           {.axial_force = section.axial_force,
                                                            .moment_1 = section.moment_1,
                                                            .moment_2 = section.moment_2,
                                                            .torque = section.torque},
                                                           section.bending_moment);
  return section;
}

void blank_bending(ElementRecord& element) {
  for (Eigen::Vector4d* values : {&element.bending_moment, &element.shear_force, &element.stress,
                                  &element.moment_1, &element.moment_2, &element.von_mises})
    values->setConstant(SectionRecord::no_number);
}

}  // namespace nurbeam
