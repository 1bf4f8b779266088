#include "fem/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/element/inertia.h"

namespace nurbeam {

namespace {

double spacing_near(const Beam& beam, double s) {
  const int h = beam.home_interval(s);
  return beam.home_place(h + 1) - beam.home_place(h);
}

// Home node, but none at an end, that gives way to a moving node at s, or -1.
int node_to_replace(const Beam& beam, double s) {
  const int h = beam.home_interval(s);
  const auto at = [&](int i) { return beam.home_place(i); };
  const auto can_go = [&](int i) {
    if (!beam.is_ring() && (i <= 0 || i >= beam.home_intervals())) return false;
    return beam.home[beam.home_index(i)].kind == NodeKind::smooth;
  };
  const bool first = can_go(h) && (!can_go(h + 1) || s - at(h) <= at(h + 1) - s);
  const int nearest = first ? h : h + 1;
  if (!can_go(nearest)) return -1;
  const double gap = at(nearest) < s ? at(nearest + 1) - at(nearest) : at(nearest) - at(nearest - 1);
  const HomeNode& node = beam.home[beam.home_index(nearest)];
  const double reach = node.late ? late_zone : 0.5;
  return std::abs(at(nearest) - s) <= reach * gap ? beam.home_index(nearest) : -1;
}

// Whether a break of the drawing that has no node lies strictly between two places.
bool spans_break(const Beam& beam, double s_a, double s_b) {
  const double near = 1e-12 * beam.curve.length();
  return beam.curve.next_break(s_a + near) < s_b - near;
}

std::array<double, 4> drawn_weights(const ReferenceCurve& curve, int segment, double s_a, double s_b) {
  const Eigen::Matrix4d points =
      curve.segment(segment)
          .piece(std::max(0.0, curve.parameter(segment, s_a)), std::min(1.0, curve.parameter(segment, s_b)))
          .points();
  return {points(3, 0), points(3, 1), points(3, 2), points(3, 3)};
}

Chart choose_chart(const Beam& beam, const MeshPlan& plan, int beam_index, double s_a, double s_b,
                   bool arc_length) {
  Chart chart;
  if (beam.weights == WeightRule::ones) return chart;
  if (!arc_length) chart.segment = beam.curve.segment_at((s_a + s_b) / 2);
  if (beam.weights == WeightRule::material) return chart;
  for (const MeshPlan::Weights& w : plan.weights)
    if (w.beam == beam_index && w.s_a == s_a && w.s_b == s_b) chart.constant_weights = w.w;
  if (!chart.constant_weights && !arc_length)
    chart.constant_weights = drawn_weights(beam.curve, chart.segment, s_a, s_b);
  return chart;
}

// The drawn slope before a node minus that after it, for the element before it.
template <int D>
Eigen::Matrix<double, D, 1> drawn_slope_jump(const Beam& beam, const MeshNode& node) {
  if (node.joint >= 0 || node.slope_left != node.slope_right) return Eigen::Matrix<double, D, 1>::Zero();
  return (beam.curve.tangent(node.s, true) - beam.curve.tangent(node.s)).template head<D>();
}

}  // namespace

bool passes_as_point(const BeamModel& model, const SlidingJoint& joint, int h) {
  const Beam& beam = model.beams[joint.beam];
  const HomeNode& node = beam.home[beam.home_index(h)];
  if (!node.late || node.kind != NodeKind::smooth) return false;
  return joint.continuous_slope ||
         std::any_of(model.supports.begin(), model.supports.end(), [&](const Support& support) {
           return support.beam == joint.beam && support.s == node.s;
         });
}

bool near_as_point(const BeamModel& model, const SlidingJoint& joint, double s, double reach) {
  const Beam& beam = model.beams[joint.beam];
  const int before = beam.home_interval(s);
  const double distance = reach * (beam.home_place(before + 1) - beam.home_place(before));
  const auto near = [&](int h) {
    return std::abs(beam.home_place(h) - s) <= distance && passes_as_point(model, joint, h);
  };
  return near(before) || near(before + 1);
}

MeshPlan initial_plan(const BeamModel& model) {
  MeshPlan plan;
  for (const Beam& beam : model.beams) plan.present.emplace_back(beam.home.size(), true);
  for (const SlidingJoint& joint : model.joints) {
    const Beam& beam = model.beams[joint.beam];
    const double from_end = std::min(joint.s, beam.curve.length() - joint.s);
    const bool on_point = (!beam.is_ring() && from_end < end_zone * spacing_near(beam, joint.s)) ||
                          near_as_point(model, joint, joint.s, late_zone);
    plan.modes.push_back(on_point ? JointMode::point : JointMode::node);
    plan.places.push_back(joint.s);
    if (on_point) continue;
    const int replaced = node_to_replace(beam, joint.s);
    if (replaced >= 0) plan.present[joint.beam][replaced] = false;
  }
  return plan;
}

template <int D>
Mesh<D> make_mesh(const BeamModel& model, MeshPlan plan) {
  Mesh<D> mesh;
  int next = 0;
  const auto take = [&next](int n) { return std::exchange(next, next + n); };
  mesh.joints.assign(model.joints.size(), MeshJoint{-1, -1, -1});
  for (int b = 0; b < static_cast<int>(model.beams.size()); ++b) {
    const Beam& beam = model.beams[b];
    std::vector<MeshNode> nodes;
    const double L = beam.curve.length();
    for (int h = 0; h < beam.home_intervals() + (beam.is_ring() ? 0 : 1); ++h)
      if (plan.present[b][h]) nodes.push_back({beam.home[h].s, h, -1, 0, 0, 0, -1});
    for (int j = 0; j < static_cast<int>(model.joints.size()); ++j)
      if (model.joints[j].beam == b && plan.modes[j] == JointMode::node)
        nodes.push_back({beam.curve.wrapped(plan.places[j]), -1, j, 0, 0, 0, -1});
    std::sort(nodes.begin(), nodes.end(), [](const MeshNode& x, const MeshNode& y) { return x.s < y.s; });

    for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
      MeshNode& node = nodes[i];
      node.r = take(D);
      node.slope_left = node.slope_right = take(D);
      const bool two_slopes = node.joint < 0 ? beam.home[node.home].kind != NodeKind::smooth
                                             : !model.joints[node.joint].continuous_slope;
      if (two_slopes) node.slope_right = take(D);
      if (node.joint < 0) continue;
      node.place = take(1);
      mesh.joints[node.joint] = {node.r, node.place, i};
    }

    mesh.first_element.push_back(static_cast<int>(mesh.elements.size()));
    const int count = static_cast<int>(nodes.size());
    const auto node = [&](int i) -> const MeshNode& { return nodes[(i + count) % count]; };
    const auto at = [&](int i) { return node(i).s + (i < 0 ? -L : i >= count ? L : 0); };
    const auto shift = [&](int i) { return node(i).joint >= 0 ? at(i) - plan.places[node(i).joint] : 0; };
    for (int i = 0; i < count - (beam.is_ring() ? 0 : 1); ++i) {
      const MeshNode &a = node(i), &b_node = node(i + 1);
      // Both elements beside a moving node are plain cubics in arc length while it hides a break.
      const double left = at(a.joint >= 0 ? i - 1 : i), right = at(b_node.joint >= 0 ? i + 2 : i + 1);
      std::array<int, element_size<D>> dofs;
      for (int d = 0; d < D; ++d) {
        dofs[d] = a.r + d;
        dofs[D + d] = a.slope_right + d;
        dofs[2 * D + d] = b_node.r + d;
        dofs[3 * D + d] = b_node.slope_left + d;
      }
      dofs[4 * D] = a.place;
      dofs[4 * D + 1] = b_node.place;
      Chart chart = choose_chart(beam, plan, b, a.s, at(i + 1), spans_break(beam, left, right));
      mesh.elements.push_back({b, i, (i + 1) % count, a.s, at(i + 1), shift(i), shift(i + 1), dofs,
                               drawn_slope_jump<D>(beam, b_node),
                               BeamElement<D>(beam.curve, beam.properties, std::move(chart), a.s, at(i + 1),
                                              a.place < 0 && b_node.place < 0, beam.straight)});
    }
    mesh.nodes.push_back(std::move(nodes));
  }
  mesh.first_element.push_back(static_cast<int>(mesh.elements.size()));
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (plan.modes[j] == JointMode::node) continue;
    mesh.joints[j].r = take(D);
    if (plan.modes[j] != JointMode::free) mesh.joints[j].place = take(1);
  }
  mesh.coordinate_count = next;
  mesh.plan = std::move(plan);
  return mesh;
}

template <int D>
int find_element(const BeamModel& model, const Mesh<D>& mesh, const Eigen::VectorXd& q, int beam, double s) {
  const int first = mesh.first_element[beam], last = mesh.first_element[beam + 1] - 1;
  const double start = start_of<D>(mesh.elements[first], q);
  if (model.beams[beam].is_ring()) s = start + model.beams[beam].curve.wrapped(s - start);
  for (int i = first; i < last; ++i)
    if (s < end_of<D>(mesh.elements[i], q)) return i;
  return last;
}

template <int D>
MaterialPoint<D> material_point(const MeshElement<D>& e, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                double s) {
  using Nodes = Eigen::Matrix<double, D, 4>;
  const ElementState<D> x = gather<D>(e, q, v, v);
  const ShapeFunctions<Jet> shape = e.element.shape_series(x.q, e.local(x.q, s));
  const Nodes nodes = Eigen::Map<const Nodes>(x.q.data()), rates = Eigen::Map<const Nodes>(x.v.data());
  const std::array<double, 2> w{x.v[4 * D], x.v[4 * D + 1]};
  const PointField<D> r(shape.value, nodes), rs(shape.d1, nodes), rss(shape.d2, nodes);
  return {
      r.value, rs.value, rss.value, r.rate(nodes, rates, w), rs.rate(nodes, rates, w), shape.kappa0.value()};
}

template Mesh<2> make_mesh<2>(const BeamModel&, MeshPlan);
template Mesh<3> make_mesh<3>(const BeamModel&, MeshPlan);
template int find_element<2>(const BeamModel&, const Mesh<2>&, const Eigen::VectorXd&, int, double);
template int find_element<3>(const BeamModel&, const Mesh<3>&, const Eigen::VectorXd&, int, double);
template MaterialPoint<2> material_point<2>(const MeshElement<2>&, const Eigen::VectorXd&,
                                            const Eigen::VectorXd&, double);
template MaterialPoint<3> material_point<3>(const MeshElement<3>&, const Eigen::VectorXd&,
                                            const Eigen::VectorXd&, double);

}  // namespace nurbeam
