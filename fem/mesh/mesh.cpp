#include "fem/mesh/mesh.h"

#include <algorithm>
#include <utility>

namespace nurbeam {

namespace {

// Numbers the coordinates beam by beam, then those of riders and bodies that are left.
class Numbering {
 public:
  Numbering(const Structure& structure, const MeshPlan& plan) : structure_(structure), plan_(plan) {
    mesh_.dimension = structure.dimension;
    mesh_.memory = MemoryPlaces(structure);
    mesh_.riders.assign(structure.riders.size(), {-1, -1});
    mesh_.bodies.assign(structure.bodies.size(), -1);
    mesh_.attitudes.assign(structure.bodies.size(), -1);
    std::size_t most = structure.riders.size();
    for (const Beam& beam : structure.beams) most += beam.home.size();
    mesh_.spans.reserve(most);
  }

  void add_beam(int b) {
    std::vector<MeshNode> nodes = nodes_of(b);
    for (int i = 0; i < static_cast<int>(nodes.size()); ++i) number(nodes[i], b, i);
    add_spans(b, nodes);
    mesh_.nodes.push_back(std::move(nodes));
  }

  Mesh finish() {
    mesh_.first_span.push_back(static_cast<int>(mesh_.spans.size()));
    for (std::size_t j = 0; j < structure_.riders.size(); ++j) {
      if (plan_.modes[j] == Carried::node) continue;
      body_position(structure_.riders[j].body);
      if (plan_.modes[j] != Carried::free) mesh_.riders[j].place = take(1);
    }
    for (std::size_t body = 0; body < structure_.bodies.size(); ++body) {
      body_position(static_cast<int>(body));
      if (structure_.bodies[body].rigid) mesh_.attitudes[body] = take(4);
    }
    mesh_.coordinate_count = next_;
    return std::move(mesh_);
  }

 private:
  int take(int n) { return std::exchange(next_, next_ + n); }

  int body_position(int body) {
    if (mesh_.bodies[body] < 0) mesh_.bodies[body] = take(structure_.dimension);
    return mesh_.bodies[body];
  }

  std::vector<MeshNode> nodes_of(int b) const {
    const Beam& beam = structure_.beams[b];
    std::vector<MeshNode> nodes;
    if (beam.rigid) return nodes;
    nodes.reserve(beam.home.size() + structure_.riders.size());
    for (int h = 0; h < beam.home_intervals() + (beam.is_ring() ? 0 : 1); ++h)
      if (plan_.beams[b].present[h]) nodes.push_back({beam.home[h].s, h, -1, 0, 0, 0, -1});
    for (int j = 0; j < static_cast<int>(structure_.riders.size()); ++j)
      if (structure_.riders[j].beam == b && plan_.modes[j] == Carried::node)
        insert({beam.curve.wrapped(plan_.places[j]), -1, j, 0, 0, 0, -1}, nodes);
    return nodes;
  }

  // Inserts a node into nodes ordered by s.
  static void insert(const MeshNode& node, std::vector<MeshNode>& nodes) {
    nodes.insert(
        std::upper_bound(
            nodes.begin(), nodes.end(), node, [](const MeshNode& x, const MeshNode& y) { return x.s < y.s; }),
        node);
  }

  void number(MeshNode& node, int b, int i) {
    const int D = structure_.dimension;
    const bool is_body = node.rider >= 0 && !structure_.riders[node.rider].stands_apart();
    node.r = is_body ? body_position(structure_.riders[node.rider].body) : take(D);
    node.slope_left = node.slope_right = take(D);
    const bool two_slopes = node.rider < 0 ? structure_.beams[b].home[node.home].kind != NodeKind::smooth
                                           : !structure_.riders[node.rider].continuous_slope;
    if (two_slopes) node.slope_right = take(D);
    if (structure_.beams[b].has_torsion()) {
      node.angle_left = node.angle_right = take(1);
      if (two_slopes) node.angle_right = take(1);
    }
    if (node.rider < 0) return;
    node.place = take(1);
    mesh_.riders[node.rider] = {node.place, i};
  }

  void add_spans(int b, const std::vector<MeshNode>& nodes) {
    const Beam& beam = structure_.beams[b];
    const double L = beam.curve.length();
    mesh_.first_span.push_back(static_cast<int>(mesh_.spans.size()));
    const int count = static_cast<int>(nodes.size());
    const auto node = [&](int i) -> const MeshNode& { return nodes[i % count]; };
    const auto at = [&](int i) { return node(i).s + (i >= count ? L : 0); };
    const auto shift = [&](int i) { return node(i).rider >= 0 ? at(i) - plan_.places[node(i).rider] : 0; };
    for (int i = 0; i < count - (beam.is_ring() ? 0 : 1); ++i)
      mesh_.spans.push_back({b, i, (i + 1) % count, node(i).place, node(i + 1).place,
                             beam.has_torsion() ? take(1) : -1, at(i), at(i + 1), shift(i), shift(i + 1)});
  }

  const Structure& structure_;
  const MeshPlan& plan_;
  Mesh mesh_;
  int next_ = 0;
};

// Whether a break of the drawing that has no node lies strictly between two places.
bool spans_break(const Beam& beam, double s_a, double s_b) {
  const double near = 1e-12 * beam.curve.length();
  return beam.curve.next_break(s_a + near) < s_b - near;
}

}  // namespace

Mesh make_mesh(const Structure& structure, MeshPlan plan) {
  Numbering numbering(structure, plan);
  for (int b = 0; b < static_cast<int>(structure.beams.size()); ++b) numbering.add_beam(b);
  Mesh mesh = numbering.finish();
  mesh.plan = std::move(plan);
  return mesh;
}

int find_span(const Structure& structure, const Mesh& mesh, const Eigen::VectorXd& q, int beam, double s) {
  const int first = mesh.first_span[beam], last = mesh.first_span[beam + 1] - 1;
  const double start = mesh.spans[first].start(q);
  if (structure.beams[beam].is_ring()) s = start + structure.beams[beam].curve.wrapped(s - start);
  const auto spans = mesh.spans.begin();
  const auto found = std::partition_point(spans + first, spans + last,
                                          [&](const MeshSpan& span) { return !(s < span.end(q)); });
  return static_cast<int>(found - spans);
}

std::array<int, 2> spans_at(const Mesh& mesh, int beam, int node) {
  const int first = mesh.first_span[beam], count = mesh.first_span[beam + 1] - first;
  const bool is_ring = count == static_cast<int>(mesh.nodes[beam].size());
  if (is_ring) return {first + (node + count - 1) % count, first + node};
  return {first + std::max(node - 1, 0), first + std::min(node, count - 1)};
}

bool is_arc_length_span(const Structure& structure, const Mesh& mesh, int index) {
  const MeshSpan& span = mesh.spans[index];
  const Beam& beam = structure.beams[span.beam];
  const auto length = [&](int i) { return i == index ? 0 : mesh.spans[i].s_b - mesh.spans[i].s_a; };
  double left = span.s_a, right = span.s_b;
  if (span.place_a >= 0) left -= length(spans_at(mesh, span.beam, span.node_a)[0]);
  if (span.place_b >= 0) right += length(spans_at(mesh, span.beam, span.node_b)[1]);
  return spans_break(beam, left, right);
}

}  // namespace nurbeam
