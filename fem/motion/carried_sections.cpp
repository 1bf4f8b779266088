#include "fem/motion/carried_sections.h"

#include <algorithm>

#include "fem/element/quadrature.h"
#include "fem/system/assembly.h"
#include "fem/system/material_points.h"

namespace nurbeam {

namespace {

// The present mesh of a model in space, some of whose beams have torsion.
class PresentSections {
 public:
  PresentSections(const BeamSystem& system, const State& state)
      : system_(system), state_(state), elements_(system.assembly<3>()->elements()) {}

  MeshPlan::SectionCharts of(const Mesh& fresh, const MeshSpan& span) const {
    const std::vector<MeshNode>& old = system_.mesh().nodes[span.beam];
    const int a = same_node(old, fresh.node_a(span)), b = same_node(old, fresh.node_b(span));
    const MeshElement<3>* const kept = element_between(span.beam, a, b);
    return {span.beam,
            span.s_a,
            span.s_b,
            {chart(span.beam, fresh.node_a(span), a, 0), chart(span.beam, fresh.node_b(span), b, 1)},
            kept ? kept->twist->element.turn(gather_twist(*kept, state_.q))
                 : turn(span.beam, span.s_a, span.s_b)};
  }

  // The present element between two present nodes, if there is one.
  const MeshElement<3>* element_between(int beam, int node_a, int node_b) const {
    const auto found = std::find_if(elements_.begin(), elements_.end(), [&](const MeshElement<3>& e) {
      return e.beam == beam && e.node_a == node_a && e.node_b == node_b;
    });
    return found == elements_.end() ? nullptr : &*found;
  }

  // Calls visit(element, s_0, s_1) for each present element between two places, with the part of it that lies
  // between them, in its own count of s.
  template <class Visit>
  void for_each_part(int beam, double s_a, double s_b, Visit&& visit) const {
    const double nothing = 1e-12 * (s_b - s_a);
    for (double s = s_a; s < s_b - nothing;) {
      const MeshElement<3>& e =
          elements_[find_span(system_.model(), system_.mesh(), state_.q, beam, s + nothing)];
      const double from = e.local(gather<3>(e, state_.q), s + nothing) - nothing;
      const double to = std::min(e.end(state_.q), from + s_b - s);
      if (!(to > from)) return;
      visit(e, std::max(from, e.start(state_.q)), to);
      s += to - from;
    }
  }

 private:
  Eigen::Matrix3d chart(int beam, const MeshNode& node, int kept, int end) const {
    if (kept < 0) return section_point(system_, state_, beam, node.s).triad.matrix();
    const auto at_end = [&](const MeshElement<3>& e, int side) {
      return e.beam == beam && (side == 0 ? e.node_a : e.node_b) == kept;
    };
    for (const int side : {end, 1 - end})
      for (const MeshElement<3>& e : elements_)
        if (at_end(e, side)) return e.twist->element.chart(side);
    return section_point(system_, state_, beam, node.s).triad.matrix();
  }

  double turn(int beam, double s_a, double s_b) const {
    double sum = 0;
    for_each_part(beam, s_a, s_b, [&](const MeshElement<3>& e, double s_0, double s_1) {
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

int same_node(const std::vector<MeshNode>& nodes, const MeshNode& wanted) {
  const auto is_same = [&](const MeshNode& node) {
    return node.home == wanted.home && node.joint == wanted.joint;
  };
  // In both meshes they are ordered by s, which that of a home node is in each.
  auto found = nodes.end();
  if (wanted.home >= 0)
    found = std::lower_bound(nodes.begin(), nodes.end(), wanted.s,
                             [](const MeshNode& node, double s) { return node.s < s; });
  if (found == nodes.end() || !is_same(*found)) found = std::find_if(nodes.begin(), nodes.end(), is_same);
  return found == nodes.end() ? -1 : static_cast<int>(found - nodes.begin());
}

void carry_sections(const BeamSystem& system, const State& state, MeshPlan& plan) {
  plan.section_charts.clear();
  const BeamModel& model = system.model();
  if (std::none_of(model.beams.begin(), model.beams.end(), [](const Beam& b) { return b.has_torsion(); }))
    return;
  const PresentSections present(system, state);
  const Mesh fresh = make_mesh(model, plan);
  for (const MeshSpan& span : fresh.spans)
    if (model.beams[span.beam].has_torsion()) plan.section_charts.push_back(present.of(fresh, span));
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
    for (int g = 0; g < GaussRule::size; ++g) {
      const double along = (s_1 - s_0) * GaussRule::points[g], weight = (s_1 - s_0) * GaussRule::weights[g];
      const double strain = e.twist->element.section(x.q, s_0 + along).strain.twist;
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
