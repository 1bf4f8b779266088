#include "fem/motion/remesh/carried_sections.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <span>

#include "fem/element/quadrature.h"
#include "fem/element/section_frame.h"
#include "fem/system/assembly.h"
#include "fem/system/material_points.h"

namespace nurbeam {

namespace {

// The sections of the present mesh of a model in space, some of whose beams have torsion.
class PresentSections {
 public:
  PresentSections(const BeamSystem& system, const State& state)
      : system_(system), state_(state), elements_(system.assembly<3>()->elements()) {}

  // The charts of a span of a new mesh. `like`: the charts of a neighbouring model, which may be null;
  // `turned`: per node of the beam, see turned(); empty without `like`.
  MeshPlan::SectionCharts of(const Mesh& fresh, const MeshSpan& span, const MeshPlan::SectionCharts* like,
                             const std::vector<double>& turned) const {
    const int a = kept(fresh, span, 0), b = kept(fresh, span, 1);
    const auto chart = [&](int end, int node) -> Eigen::Matrix3d {
      const int present = end == 0 ? a : b;
      if (present >= 0) return section_chart(system_, span.beam, present, end);
      if (like) return like->charts[end] * Eigen::AngleAxisd(turned[node], Eigen::Vector3d::UnitZ());
      return section_point(system_, state_, span.beam, fresh.nodes[span.beam][node].s).triad.matrix();
    };
    return {span.beam,
            span.s_a,
            span.s_b,
            {chart(0, span.node_a), chart(1, span.node_b)},
            like ? like->turn : turn(span, a, b)};
  }

  // Per node of a beam: the angle by which its chart is turned further than that of a neighbouring model.
  // Kept nodes give it; new nodes take that of the kept node before them.
  std::vector<double> turned(const Mesh& fresh, int beam,
                             std::span<const MeshPlan::SectionCharts> like) const {
    std::vector<std::optional<double>> known(fresh.nodes[beam].size());
    for (std::size_t i = 0; i < like.size(); ++i) {
      const MeshSpan& span = fresh.spans[fresh.first_span[beam] + i];
      for (const int end : {0, 1})
        if (const int present = kept(fresh, span, end); present >= 0)
          known[end == 0 ? span.node_a : span.node_b] =
              angle_in(like[i].charts[end], section_chart(system_, beam, present, end));
    }
    // On a ring the last kept node comes before the first one.
    const auto is_known = [](const std::optional<double>& each) { return each.has_value(); };
    const bool is_ring = system_.model().beams[beam].is_ring();
    const auto last = std::find_if(known.rbegin(), known.rend(), is_known);
    const auto first = std::find_if(known.begin(), known.end(), is_known);
    double before = first == known.end() ? 0 : is_ring ? **last : **first;
    std::vector<double> all;
    for (const std::optional<double>& each : known) all.push_back(before = each.value_or(before));
    return all;
  }

  // The present element between two present nodes, or null.
  const MeshElement<3>* element_between(int beam, int node_a, int node_b) const {
    const auto found = std::find_if(elements_.begin(), elements_.end(), [&](const MeshElement<3>& e) {
      return e.span->beam == beam && e.span->node_a == node_a && e.span->node_b == node_b;
    });
    return found == elements_.end() ? nullptr : &*found;
  }

  // Calls visit(element, s_0, s_1) for each present element between two places. [s_0, s_1] is the part of the
  // element that lies between them, as the element counts s.
  template <class Visit>
  void for_each_part(int beam, double s_a, double s_b, Visit&& visit) const {
    const double nothing = 1e-12 * (s_b - s_a);
    for (double s = s_a; s < s_b - nothing;) {
      const MeshElement<3>& e =
          elements_[find_span(system_.model(), system_.mesh(), state_.q, beam, s + nothing)];
      const double from = e.local(gather<3>(e, state_.q), s + nothing) - nothing;
      const double to = std::min(e.span->end(state_.q), from + s_b - s);
      if (!(to > from)) return;
      visit(e, std::max(from, e.span->start(state_.q)), to);
      s += to - from;
    }
  }

 private:
  // The node of the present mesh at an end of a new span, -1 where there is none.
  int kept(const Mesh& fresh, const MeshSpan& span, int end) const {
    return same_node(system_.mesh().nodes[span.beam], end == 0 ? fresh.node_a(span) : fresh.node_b(span));
  }

  // The turn of a new span, whose ends are the present nodes a and b where these are not -1.
  double turn(const MeshSpan& span, int a, int b) const {
    if (const MeshElement<3>* const same = element_between(span.beam, a, b))
      return same->twist->element.turn(gather_twist(*same, state_.q));
    double sum = 0;
    for_each_part(span.beam, span.s_a, span.s_b, [&](const MeshElement<3>& e, double s_0, double s_1) {
      const TwistLayout::Coordinates q = gather_twist(e, state_.q);
      sum += e.twist->element.turn_to(q, s_1) - e.twist->element.turn_to(q, s_0);
    });
    return sum;
  }

  const BeamSystem& system_;
  const State& state_;
  const std::vector<MeshElement<3>>& elements_;
};

}  // namespace

int same_node(const std::vector<MeshNode>& nodes, const MeshNode& wanted, int likely) {
  const auto is_same = [&](const MeshNode& node) {
    return node.home == wanted.home && node.rider == wanted.rider;
  };
  if (likely < static_cast<int>(nodes.size()) && is_same(nodes[likely])) return likely;
  // Both meshes order their nodes by s, and a home node has one s in both.
  auto found = nodes.end();
  if (wanted.home >= 0)
    found = std::lower_bound(nodes.begin(), nodes.end(), wanted.s,
                             [](const MeshNode& node, double s) { return node.s < s; });
  if (found == nodes.end() || !is_same(*found)) found = std::find_if(nodes.begin(), nodes.end(), is_same);
  return found == nodes.end() ? -1 : static_cast<int>(found - nodes.begin());
}

const Eigen::Matrix3d& section_chart(const BeamSystem& system, int beam, int node, int end) {
  const Mesh& mesh = system.mesh();
  const int first = mesh.first_span[beam], count = mesh.first_span[beam + 1] - first;
  const bool is_ring = system.model().beams[beam].is_ring();
  if (!is_ring && (end == 0 ? node == count : node == 0)) end = 1 - end;
  const int span = end == 0 ? node : (node + count - 1) % count;
  return system.assembly<3>()->elements()[first + span].twist->element.chart(end);
}

void carry_sections(const BeamSystem& system, const State& state, MeshPlan& plan, const MeshPlan* like) {
  plan.section_charts.clear();
  const BeamModel& model = system.model();
  if (std::none_of(model.beams.begin(), model.beams.end(), [](const Beam& b) { return b.has_torsion(); }))
    return;
  const PresentSections present(system, state);
  const Mesh fresh = make_mesh(model, plan);
  for (int b = 0; b < static_cast<int>(model.beams.size()); ++b) {
    if (!model.beams[b].has_torsion()) continue;
    const int first = fresh.first_span[b], end = fresh.first_span[b + 1];
    const MeshPlan::SectionCharts* of_like =
        like ? like->section_charts.data() + plan.section_charts.size() : nullptr;
    std::vector<double> turned;
    if (of_like) turned = present.turned(fresh, b, {of_like, static_cast<std::size_t>(end - first)});
    for (int i = first; i < end; ++i)
      plan.section_charts.push_back(
          present.of(fresh, fresh.spans[i], of_like ? of_like + (i - first) : nullptr, turned));
  }
}

CarriedTwist carried_twist(const BeamSystem& system, const State& state, const MeshSpan& span,
                           const State& next) {
  const PresentSections present(system, state);
  const double s_a = span.start(next.q), h = span.end(next.q) - s_a;
  CarriedTwist carried;
  int parts = 0;
  double before = 0;  // length of the parts before
  present.for_each_part(span.beam, s_a, s_a + h, [&](const MeshElement<3>& e, double s_0, double s_1) {
    const TwistState x = gather_twist(e, state);
    const double l = x.q[TwistLayout::place(1)] - x.q[TwistLayout::place(0)];
    const auto [strain_a, strain_b] = e.twist->element.twist_strain(x.q);
    for (int g = 0; g < GaussRule::size; ++g) {
      const double along = (s_1 - s_0) * GaussRule::points[g], weight = (s_1 - s_0) * GaussRule::weights[g];
      const double xi = (s_0 + along - x.q[TwistLayout::place(0)]) / l;
      const double strain = (1 - xi) * strain_a + xi * strain_b;
      carried.bubble += 0.75 * weight * strain * (1 - 2 * (before + along) / h);
    }
    // beta X^2 with X = h/l.
    const double l_rate = x.v[TwistLayout::place(1)] - x.v[TwistLayout::place(0)];
    const double h_rate =
        (span.place_b >= 0 ? next.v[span.place_b] : 0) - (span.place_a >= 0 ? next.v[span.place_a] : 0);
    const double X = h / l, X_rate = (h_rate - X * l_rate) / l;
    const double beta = x.q[TwistLayout::bubble], beta_rate = x.v[TwistLayout::bubble];
    carried.bubble_rate = parts == 0 ? beta_rate * X * X + 2 * beta * X * X_rate : 0;
    before += s_1 - s_0;
    ++parts;
  });
  return carried;
}

}  // namespace nurbeam
