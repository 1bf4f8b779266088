#include "fem/motion/remesh/carried_weights.h"

#include <algorithm>

#include "fem/comparison/merged_weights.h"
#include "fem/system/material_points.h"

namespace nurbeam {

namespace {

using Weights = std::array<double, 4>;

// The chart segment of a new span, by its middle; -1 for arc length.
int segment_of(const BeamModel& model, const Mesh& mesh, int span) {
  if (is_arc_length_span(model, mesh, span)) return -1;
  const MeshSpan& s = mesh.spans[span];
  return model.beams[s.beam].curve.segment_at((s.s_a + s.s_b) / 2);
}

Weights part_of(const Eigen::Vector4d& weights, double from, double to) {
  Eigen::Matrix4d line = Eigen::Matrix4d::Zero();
  line.row(3) = weights.transpose();
  const Eigen::Matrix4d part =
      RationalCubic(line).piece(std::clamp(from, 0.0, 1.0), std::clamp(to, 0.0, 1.0)).points();
  return {part(3, 0), part(3, 1), part(3, 2), part(3, 3)};
}

// Merged weights from the old spans `first` and `last`, whose common node the new mesh has lost.
Weights merged(const BeamSystem& system, const State& state, int first, int last, const MeshSpan& span,
               int segment) {
  const ReferenceCurve& curve = system.model().beams[span.beam].curve;
  const auto u = [&](double s) { return segment < 0 ? s : curve.parameter(segment, s); };
  const auto stretch = [&](double s) { return segment < 0 ? 1 : curve.geometry(segment, u(s)).stretch[0]; };
  const MeshNode& lost = system.mesh().node_b(system.mesh().spans[first]);
  const double s_h = lost.place >= 0 ? state.q[lost.place] : lost.s;
  const MaterialPoint<3> a = material_point_in(system, state, first, span.s_a);
  const MaterialPoint<3> h = material_point_in(system, state, first, s_h);
  const MaterialPoint<3> b = material_point_in(system, state, last, span.s_b);
  const double l = u(span.s_b) - u(span.s_a);
  return merged_weights(system.dimension(), a.r, l * stretch(span.s_a) * a.rs, b.r,
                        l * stretch(span.s_b) * b.rs, h.r, (u(s_h) - u(span.s_a)) / l);
}

}  // namespace

void carry_weights(const BeamSystem& system, const State& state, MeshPlan& plan) {
  plan.weights.clear();
  const BeamModel& model = system.model();
  const Mesh& old = system.mesh();
  const auto constant = [](const Beam& beam) { return beam.weights == WeightRule::constant; };
  if (std::none_of(model.beams.begin(), model.beams.end(), constant)) return;
  const Mesh fresh = make_mesh(model, plan);
  for (int i = 0; i < static_cast<int>(fresh.spans.size()); ++i) {
    const MeshSpan& span = fresh.spans[i];
    const Beam& beam = model.beams[span.beam];
    if (!constant(beam)) continue;
    const double inset = 1e-9 * (span.s_b - span.s_a);
    const int first = find_span(model, old, state.q, span.beam, span.s_a + inset);
    const int last = find_span(model, old, state.q, span.beam, span.s_b - inset);
    const int segment = segment_of(model, fresh, i);
    Weights w{1, 1, 1, 1};
    if (first == last) {
      const auto u = [&](double s) { return segment < 0 ? s : beam.curve.parameter(segment, s); };
      const double u0 = u(old.spans[first].start(state.q)), u1 = u(old.spans[first].end(state.q));
      w = part_of(element_weights(system, state, first), (u(span.s_a) - u0) / (u1 - u0),
                  (u(span.s_b) - u0) / (u1 - u0));
    } else if (beam.merge != MergeRule::ones) {
      w = merged(system, state, first, last, span, segment);
    }
    plan.weights.push_back({span.beam, span.s_a, span.s_b, w});
  }
}

}  // namespace nurbeam
